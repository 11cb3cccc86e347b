// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random valid scenes: full ranges, narrowed only where one value depends on another. One file, because it follows the scene from top to
//! bottom.

use glam::{Vec2, Vec3};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

use crate::motion::{MotionConstants, Primitive, TransitionTable};
use crate::scene::limits::{self, Limit};
use crate::scene::*;

fn within(limit: Limit<f32>) -> BoxedStrategy<f32> {
    prop_oneof![8 => limit.low..=limit.high, 1 => Just(limit.low), 1 => Just(limit.high)].boxed()
}

fn maybe(limit: Limit<f32>) -> BoxedStrategy<Option<f32>> {
    option::of(within(limit)).boxed()
}

fn vector(limit: Limit<f32>) -> impl Strategy<Value = Vec3> {
    [within(limit), within(limit), within(limit)].prop_map(Vec3::from_array)
}

prop_compose! {
    fn motion()(
        (descent_m_s, horizontal_m_s, vertical_m_s) in
            (option::of(1.0f32..10.0), maybe(limits::HORIZONTAL_M_S), maybe(limits::VERTICAL_M_S)),
        (flutter_rad_s, tumble_rad_s, spiral_rad_s) in
            (option::of(0.5f32..11.0), option::of(0.5f32..11.0), option::of(0.5f32..11.0)),
        (tumble_wobble, chaos_keep, chaos_jitter) in
            (maybe(limits::TUMBLE_WOBBLE), maybe(limits::CHAOS_KEEP), maybe(limits::CHAOS_JITTER)),
        (rose_radius_m, rose_ellipticity, rose_swings) in
            (maybe(limits::ROSE_RADIUS_M), maybe(limits::ROSE_ELLIPTICITY), option::of(2u32..=12)),
        (cone_shape, cone_radius_m, cone_depth_m, cone_rad_s) in (
            option::of(select(vec![ConeShape::Bowl, ConeShape::Cone])), maybe(limits::CONE_RADIUS_M),
            maybe(limits::CONE_DEPTH_M), option::of(0.5f32..11.0),
        ),
        (cone_unevenness, corner_swing_deg, corner_swing_rad_s) in
            (maybe(limits::CONE_UNEVENNESS), maybe(limits::CORNER_SWING_DEG), option::of(0.5f32..11.0)),
        (spiral_radius_m, wander_m_s, wander_s) in
            (maybe(limits::SPIRAL_RADIUS_M), maybe(limits::WANDER_M_S), maybe(limits::WANDER_S)),
    ) -> MotionParameters {
        MotionParameters {
            descent_m_s, horizontal_m_s, vertical_m_s, flutter_rad_s, tumble_rad_s, tumble_wobble, chaos_keep,
            chaos_jitter, rose_radius_m, rose_ellipticity, rose_swings, spiral_radius_m, spiral_rad_s, wander_m_s,
            wander_s, cone_shape, cone_radius_m, cone_depth_m, cone_rad_s, cone_unevenness, corner_swing_deg,
            corner_swing_rad_s,
        }
    }
}

prop_compose! {
    fn aerodynamics()(
        planform in option::of((within(limits::ASPECT), within(limits::EXTENT))),
        rod in option::of((
            within(limits::PETIOLE_BASE), within(limits::PETIOLE_LENGTH), within(limits::PETIOLE_MASS),
            within(limits::DROOP_DEG),
        )),
        (moisture, curl, twist) in (within(limits::MOISTURE), within(limits::CURL), within(limits::TWIST)),
        mass_offset in (within(limits::MASS_OFFSET), within(limits::MASS_OFFSET)),
        (irregularity, tilt_deg) in (within(limits::IRREGULARITY), within(limits::TILT_DEG)),
        gyration in (within(limits::GYRATION), within(limits::GYRATION)),
        (edge_drag, pitch_damping) in (within(limits::EDGE_DRAG), within(limits::PITCH_DAMPING)),
        hold in select(vec![Hold::Random, Hold::Broadside, Hold::EdgeOn]),
    ) -> Aerodynamics {
        let planform = planform.map(|(aspect, extent)| Planform { aspect, extent });
        let petiole = rod.map(|(base, length, mass, droop_deg)| PetioleRod { base, length, mass, droop_deg });
        Aerodynamics {
            planform, petiole, moisture, mass_offset, curl, twist, gyration, edge_drag, pitch_damping, irregularity, hold, tilt_deg,
        }
    }
}

prop_compose! {
    /// Every name is made unique later.
    fn species()(
        name in "[^\\p{C}]{0,12}",
        shape in select(vec![
            LeafShape::Maple, LeafShape::Oak, LeafShape::Birch, LeafShape::Beech, LeafShape::Linden, LeafShape::Ginkgo,
            LeafShape::JapaneseMaple, LeafShape::Hornbeam, LeafShape::Feather, LeafShape::Paper, LeafShape::Plate,
            LeafShape::Samara,
        ]),
        season in (within(limits::SEASON), within(limits::SEASON)),
        (size_m, size_variation, speed_variation) in
            (within(limits::SIZE_M), within(limits::SIZE_VARIATION), within(limits::SPEED_VARIATION)),
        (areal_density_kg_m2, spin_rad_s) in (within(limits::AREAL_DENSITY_KG_M2), within(limits::SPIN_RAD_S)),
        flight in option::of(aerodynamics()),
        start in select(Primitive::ALL.to_vec()),
        rows in proptest::array::uniform6(proptest::array::uniform6(0u32..10_000)),
        motion in motion(),
        friction in maybe(limits::FRICTION_PER_S),
        tables in option::of("[^\\p{C}]{1,20}"),
        leaves in option::of("[^\\p{C}]{1,20}"),
    ) -> Species {
        let mut transitions = TransitionTable(rows);
        for row in &mut transitions.0 {
            row[0] += 1;
        }
        let mut species = Species {
            name,
            shape,
            season: (season.0.min(season.1), season.0.max(season.1)),
            size_m, size_variation, speed_variation, areal_density_kg_m2,
            flight: flight.map_or(FlightModel::Synthesis, FlightModel::Aerodynamic),
            spin_rad_s, start, transitions, motion,
            rotation: friction.map_or(RotationModel::SpecificForce, |friction_per_s| {
                RotationModel::TanabeKaneko { friction_per_s }
            }),
            tables,
            leaves,
            burns: None,
        };
        let rates = MotionConstants::of(&species, STANDARD_GRAVITY_M_S2);
        if rates.tumble_rad_s.max(rates.flutter_rad_s) > 11.0 {
            // Too fast a leaf for the steps below.
            (species.motion.flutter_rad_s, species.motion.tumble_rad_s) = (Some(7.0), Some(11.0));
        }
        species
    }
}

fn shape() -> impl Strategy<Value = SourceShape> {
    // Between the highest ground and a height that the slowest leaf falls from in 60,000 steps.
    let center = (within(limits::CENTER_M), 8.0f32..12.0, within(limits::CENTER_M));
    let center = center.prop_map(|(x, y, z)| Vec3::new(x, y, z));
    let half = (within(limits::HALF_EXTENT_M), 0.0f32..4.0, within(limits::HALF_EXTENT_M));
    let half = half.prop_map(|(x, y, z)| Vec3::new(x, y, z));
    prop_oneof![
        (center.clone(), half)
            .prop_map(|(center_m, half_extent_m)| SourceShape::Box { center_m, half_extent_m }),
        (center.clone(), within(limits::RADIUS_M))
            .prop_map(|(center_m, radius_m)| SourceShape::Disc { center_m, radius_m }),
        (center, 0.0f32..4.0).prop_map(|(center_m, radius_m)| SourceShape::Sphere { center_m, radius_m }),
    ]
}

fn source() -> impl Strategy<Value = Source> {
    let release = prop_oneof![
        within(limits::AT_S).prop_map(|at_s| Release::Burst { at_s }),
        (within(limits::PER_S), within(limits::FROM_S))
            .prop_map(|(per_s, from_s)| Release::Rate { per_s, from_s }),
    ];
    (shape(), 1u32..=10_000, release, maybe(limits::RECYCLE_AFTER_S), vec(1u32..=1000, 0..4)).prop_map(
        |(shape, count, release, recycle_after_s, weights)| {
            // Names are filled in when the species are known.
            let species =
                weights.into_iter().map(|weight| Share { species: String::new(), weight }).collect();
            Source { shape, count, release, recycle_after_s, species }
        },
    )
}

prop_compose! {
    fn weather()(
        center in vector(limits::CENTER_M),
        size in vector(limits::SNOW_EDGE_M),
        (snow, air) in (vec(within(limits::SNOW_MM_H), 1..4), vec(within(limits::AIR_C), 1..4)),
        lying_mm in within(limits::LYING_MM),
        lying_h in within(limits::LYING_H),
    ) -> Weather {
        let curve = |numbers: Vec<f32>| {
            numbers.into_iter().enumerate().map(|(key, number)| (2.5 * key as f32, number)).collect()
        };
        let (center_m, size_m) = (Vec2::new(center.x, center.z), Vec2::new(size.x, size.z));
        Weather { center_m, size_m, snow_mm_h: curve(snow), air_c: curve(air), lying_mm, lying_h }
    }
}

prop_compose! {
    fn vortex()(
        center_m in vector(limits::CENTER_M),
        axis in (vector(limits::AXIS), 0.001f32..=1000.0).prop_map(|(axis, z)| axis.with_z(z)),
        circulation_m2_s in within(limits::CIRCULATION_M2_S),
        core_m in within(limits::CORE_M),
        axial_m_s in within(limits::AXIAL_M_S),
        drift_m_s in vector(limits::DRIFT_M_S),
        (kind, d) in (0u32..6, within(limits::SWIRL_D)),
    ) -> Vortex {
        let profile = match kind {
            0..=2 => VortexProfile::Power { alpha: kind },
            3 => VortexProfile::Compact { d },
            _ => VortexProfile::Kaufmann,
        };
        let points = 4 * (kind % 2);
        let spline_m = (0..points).map(|number| center_m * 0.5 + axis * (0.5 * number as f32)).collect();
        Vortex { center_m, axis, circulation_m2_s, core_m, axial_m_s, drift_m_s, profile, spline_m }
    }
}

/// A jet with keys a second apart.
fn jet() -> impl Strategy<Value = Jet> {
    let key = (vector(limits::JET_M), vector(limits::JET_M), within(limits::JET_SPEED_M_S));
    (within(limits::NOZZLE_M), vec(key, 1..4), 0f32..1000.0).prop_map(|(nozzle_m, ends, from_s)| {
        let mut keys: Vec<JetKey> = Vec::new();
        for (at_m, toward_m, speed_m_s) in ends {
            let time_s = keys.last().map_or(from_s, |key| key.time_s + 1.0);
            // Points apart.
            let at_m = at_m.with_y(toward_m.y - toward_m.y.signum());
            keys.push(JetKey { time_s, at_m, toward_m, speed_m_s });
        }
        Jet { nozzle_m, keys }
    })
}

/// Plumes of one name each, with keys a second apart.
fn plumes() -> impl Strategy<Value = Vec<Plume>> {
    let power = vec(within(limits::POWER_KW), 1..4);
    let plume = (vector(limits::JET_M), within(limits::BASE_RADIUS_M), power, 0f32..1000.0);
    vec(plume, 0..=MAX_PLUMES).prop_map(|plumes| {
        let named = plumes.into_iter().enumerate();
        named
            .map(|(number, (at_m, base_radius_m, power, from_s))| {
                let key = |(late, power_kw)| PlumeKey { time_s: from_s + late as f32, power_kw };
                let keys = power.into_iter().enumerate().map(key).collect();
                Plume { name: format!("fire {number}"), at_m, base_radius_m, keys, fed_within_m: None }
            })
            .collect()
    })
}

prop_compose! {
    fn wind()(
        direction_deg in within(limits::DIRECTION_DEG),
        speed in prop_oneof![
            within(limits::METRES_PER_SECOND).prop_map(MeanSpeed::MetresPerSecond),
            (0u8..=12).prop_map(MeanSpeed::Beaufort),
        ],
        reference_height_m in 14.5f32..=100.0,
        profile in prop_oneof![
            Just(Profile::Uniform),
            within(limits::EXPONENT).prop_map(|exponent| Profile::Power { exponent }),
            (within(limits::ROUGHNESS_M), within(limits::DISPLACEMENT_M))
                .prop_map(|(roughness_m, displacement_m)| Profile::Log { roughness_m, displacement_m }),
        ],
        gusts in (within(limits::STRENGTH), within(limits::INTERVAL_S))
            .prop_map(|(strength, interval_s)| Gusts { strength, interval_s }),
        turbulence in (within(limits::INTENSITY), within(limits::CELL_M), within(limits::CALM_M_S))
            .prop_map(|(intensity, cell_m, calm_m_s)| Turbulence { intensity, cell_m, calm_m_s }),
        shelter in any::<bool>(),
        (vortices, jets, plumes) in
            (vec(vortex(), 0..=MAX_VORTICES), vec(jet(), 0..=MAX_JETS), plumes()),
    ) -> WindParameters {
        let uniform =
            WindParameters { direction_deg, speed, reference_height_m, profile, ..WindParameters::default() };
        WindParameters { gusts, turbulence, shelter, vortices, jets, plumes, ..uniform }
    }
}

prop_compose! {
    fn terrain()(
        seed in any::<u64>(),
        (edge_m, relief_m) in (within(limits::EDGE_M), within(limits::RELIEF_M)),
        (levels, smoothing) in (2u32..=9, 0u32..=8),
        (noise, pulled) in (within(limits::NOISE), within(limits::PULLED)),
    ) -> Terrain {
        Terrain { seed, edge_m, relief_m, levels, noise, pulled, smoothing }
    }
}

prop_compose! {
    fn lens()(
        exposure in prop_oneof![
            (within(limits::COMPENSATION_EV), within(limits::ADAPTATION_S))
                .prop_map(|(compensation_ev, adaptation_s)| Exposure::Auto { compensation_ev, adaptation_s }),
            within(limits::EV100).prop_map(|ev100| Exposure::Manual { ev100 }),
        ],
        tone_map in prop_oneof![
            within(limits::GAMMA).prop_map(|gamma| ToneMap::Linear { gamma }),
            within(limits::WHITE).prop_map(|white| ToneMap::Reinhard { white }),
            Just(ToneMap::AgX),
        ],
        (threshold, strength) in (within(limits::GLARE_THRESHOLD), within(limits::GLARE_STRENGTH)),
        focus in option::of((within(limits::FOCUS_DISTANCE_M), within(limits::F_NUMBER))),
        (saturation, vignette) in (within(limits::SATURATION), within(limits::VIGNETTE)),
        shutter_s in within(limits::SHUTTER_S),
    ) -> Lens {
        Lens {
            exposure, tone_map, glare: Glare { threshold, strength },
            focus: focus.map(|(distance_m, f_number)| Focus { distance_m, f_number }), shutter_s, saturation, vignette,
        }
    }
}

prop_compose! {
    /// Its time is the span since the key before, until the path is put together.
    fn camera_key()(
        time_s in 0.01f32..1000.0,
        eye_m in (vector(limits::CAMERA_M), -1e5f32..=0.0).prop_map(|(eye, z)| eye.with_z(z)),
        target_m in (vector(limits::CAMERA_M), 1.0f32..=1e5).prop_map(|(target, z)| target.with_z(z)),
        vertical_fov_deg in within(limits::VERTICAL_FOV_DEG),
    ) -> CameraKey {
        CameraKey { time_s, eye_m, target_m, vertical_fov_deg }
    }
}

prop_compose! {
    fn view()(
        eye_m in (vector(limits::CAMERA_M), -1e5f32..=0.0).prop_map(|(eye, z)| eye.with_z(z)),
        target_m in (vector(limits::CAMERA_M), 1.0f32..=1e5).prop_map(|(target, z)| target.with_z(z)),
        vertical_fov_deg in within(limits::VERTICAL_FOV_DEG),
        azimuth_deg in within(limits::AZIMUTH_DEG),
        elevation_deg in within(limits::ELEVATION_DEG),
        sky in prop_oneof![
            (within(limits::AEROSOL), within(limits::CLOUD_COVER))
                .prop_map(|(aerosol, cloud_cover)| Sky::Physical(PhysicalSky { aerosol, cloud_cover })),
            ("[^\\p{C}]{1,20}", within(limits::ROTATION_DEG), within(limits::INTENSITY_KCD_M2)).prop_map(
                |(path, rotation_deg, intensity_kcd_m2)| Sky::Map(SkyMap { path, rotation_deg, intensity_kcd_m2 })
            ),
        ],
        haze in (within(limits::VISIBILITY_M), within(limits::HAZE_DEPTH_M))
            .prop_map(|(visibility_m, depth_m)| Haze { visibility_m, depth_m }),
        trail_s in within(limits::TRAIL_S),
        mut path in vec(camera_key(), 0..6),
        lens in lens(),
    ) -> View {
        for index in 1..path.len() {
            path[index].time_s += path[index - 1].time_s;
        }
        View {
            camera: Camera { eye_m, target_m, vertical_fov_deg },
            path,
            lens,
            sun: Sun { azimuth_deg, elevation_deg },
            sky,
            haze,
            trail_s,
        }
    }
}

fn crown_hull() -> impl Strategy<Value = CrownHull> {
    let rings = (0.0f32..0.4, vec(within(limits::HULL_RADIUS_M), 1..5), 0.6f32..=1.0);
    prop_oneof![
        (within(limits::TREE_HEIGHT_M), rings, within(limits::BULGES)).prop_map(
            |(height_m, (low, between, high), bulges)| {
                let steps = between.len() as f32 + 1.0;
                let mut radii = vec![(low, 0.0)];
                radii.extend(
                    (1u8..).zip(between).map(|(at, radius_m)| {
                        (low + (high - low) * f32::from(at) / steps, radius_m.max(0.01))
                    }),
                );
                radii.push((high, 0.0));
                CrownHull::Profile { height_m, radii, bulges }
            }
        ),
        ("[^\\p{C}]{1,20}", within(limits::MESH_SCALE))
            .prop_map(|(file, scale)| CrownHull::Mesh { file, scale }),
    ]
}

prop_compose! {
    fn crown_light()(
        nodes in limits::LIGHT_NODES.low..=limits::LIGHT_NODES.high,
        (extinction_per_m, direct) in (within(limits::EXTINCTION_PER_M), within(limits::LIGHT_SHARE)),
        (azimuth_deg, elevation_deg) in (within(limits::AZIMUTH_DEG), within(limits::ELEVATION_DEG)),
    ) -> CrownLight {
        CrownLight { nodes, extinction_per_m, direct, sun: Sun { azimuth_deg, elevation_deg } }
    }
}

prop_compose! {
    fn particle_flow()(
        (hull, shade) in (crown_hull(), crown_light()),
        particles in limits::CROWN_PARTICLES.low..=limits::CROWN_PARTICLES.high,
        (to_root, to_particle) in (within(limits::TO_ROOT), within(limits::TO_PARTICLE)),
        (step_m, light) in (within(limits::GROWTH_STEP_M), within(limits::LIGHT_SHARE)),
        (trunk, girth) in (within(limits::TRUNK), within(limits::GIRTH)),
    ) -> ParticleFlow {
        ParticleFlow { hull, particles, to_root, to_particle, step_m, light, trunk, girth, shade }
    }
}

prop_compose! {
    fn space_colonization()(
        (hull, shade) in (crown_hull(), crown_light()),
        points in limits::CROWN_PARTICLES.low..=limits::CROWN_PARTICLES.high,
        // No step is longer than the distance at which points go, which is less than that of influence.
        (influence_m, kill_m, step_m) in (10.01f32..20.0, 1.0f32..=10.0, within(limits::GROWTH_STEP_M)),
        light in within(limits::LIGHT_SHARE),
        (trunk, girth) in (within(limits::TRUNK), within(limits::GIRTH)),
    ) -> SpaceColonization {
        SpaceColonization { hull, points, influence_m, kill_m, step_m, light, trunk, girth, shade }
    }
}

prop_compose! {
    /// Every name is made unique, and the species one of the scene's, later.
    fn tree_kind()(
        name in "[^\\p{C}]{0,12}",
        form in prop_oneof![
            select(TreePreset::ALL.to_vec()).prop_map(TreeForm::Preset),
            "[^\\p{C}]{1,20}".prop_map(TreeForm::File),
            particle_flow().prop_map(TreeForm::ParticleFlow),
            space_colonization().prop_map(TreeForm::SpaceColonization),
            (1u32..20, "[^\\p{Cc}]{0,20}").prop_map(|(steps, remark)| {
                TreeForm::Grammar(format!("# {remark}\niterations = {steps};\naxiom A; A -> F [ +F L ] A;"))
            }),
        ],
        (youngs_modulus_gpa, density_kg_m3) in
            (within(limits::YOUNGS_MODULUS_GPA), within(limits::DENSITY_KG_M3)),
        (damping, wood_drag, anchorage) in
            (within(limits::DAMPING), within(limits::WOOD_DRAG), within(limits::ANCHORAGE)),
        species in option::of(Just(String::new())),
        (leaf_area_index, leaf_drag) in (within(limits::LEAF_AREA_INDEX), within(limits::LEAF_DRAG)),
        (yield_m_s, strength_n, areal_density_kg_m2) in
            (within(limits::YIELD_M_S), within(limits::STRENGTH_N), within(limits::LEAF_DENSITY_KG_M2)),
    ) -> TreeKind {
        TreeKind {
            name,
            form,
            wood: Wood { youngs_modulus_gpa, density_kg_m3, damping, drag: wood_drag, anchorage },
            foliage: Foliage { species, leaf_area_index, areal_density_kg_m2, drag: leaf_drag, yield_m_s, strength_n },
        }
    }
}

prop_compose! {
    /// The kind is replaced by one of the scene's own later, if it has any.
    fn tree()(
        kind in select(vec!["maple", "Birch", "OAK", "bush", "weed", "Berry-Bush"]),
        at_m in [within(limits::AT_M), within(limits::AT_M)],
        height_m in maybe(limits::TREE_HEIGHT_M),
        (age, heading_deg) in (within(limits::AGE), within(limits::HEADING_DEG)),
        number in any::<u32>(),
        leaves in 0..=limits::TREE_LEAVES.high,
    ) -> Tree {
        Tree { kind: kind.into(), at_m, height_m, age, heading_deg, number, leaves }
    }
}

fn object_shape() -> impl Strategy<Value = ObjectShape> {
    let radius = || within(limits::OBJECT_RADIUS_M);
    prop_oneof![
        radius().prop_map(|radius_m| ObjectShape::Sphere { radius_m }),
        (radius(), within(limits::OBJECT_LENGTH_M))
            .prop_map(|(radius_m, length_m)| ObjectShape::Capsule { radius_m, length_m }),
        vector(limits::OBJECT_SIZE_M).prop_map(|size_m| ObjectShape::Box { size_m }),
        (radius(), within(limits::OBJECT_HEIGHT_M))
            .prop_map(|(radius_m, height_m)| ObjectShape::Cylinder { radius_m, height_m }),
        Just(ObjectShape::Plane),
        vector(limits::OBJECT_SIZE_M).prop_map(|size_m| ObjectShape::Polyhedron {
            corners_m: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]
                .map(|corner| corner * size_m.min(Vec3::splat(limits::CORNER_M.high)))
                .to_vec(),
        }),
        ("[a-z]{1,12}\\.glb", within(limits::MESH_SCALE))
            .prop_map(|(file, scale)| ObjectShape::Mesh { file, scale }),
    ]
}

fn object_motion() -> impl Strategy<Value = ObjectMotion> {
    let key = (vector(limits::OBJECT_AT_M), within(limits::TURNED_DEG));
    let path = (0.0f32..100.0, vec(((0.01f32..100.0), key), 1..6)).prop_map(|(first_s, keys)| {
        let mut time_s = first_s;
        let keys = keys.into_iter().map(|(later_s, (moved_m, turned_deg))| {
            time_s += later_s;
            ObjectKey { time_s, moved_m, turned_deg }
        });
        ObjectMotion::Path(keys.collect())
    });
    prop_oneof![2 => Just(ObjectMotion::Still), 1 => path]
}

prop_compose! {
    fn object()(
        shape in object_shape(),
        at_m in vector(limits::OBJECT_AT_M),
        (heading_deg, tilt_deg) in (within(limits::HEADING_DEG), within(limits::OBJECT_TILT_DEG)),
        motion in object_motion(),
        friction in prop_oneof![
            within(limits::COULOMB).prop_map(ObjectFriction::Coulomb), within(limits::LOSS).prop_map(ObjectFriction::Loss),
        ],
        (restitution, open) in (within(limits::RESTITUTION), within(limits::OPEN)),
        (color, finish) in (vector(limits::COLOR), select(Finish::ALL.to_vec())),
    ) -> Object {
        Object { shape, at_m, heading_deg, tilt_deg, motion, friction, restitution, open, color, finish }
    }
}

prop_compose! {
    fn walker()(
        (x_m, z_m) in (within(limits::OBJECT_AT_M), -4000.0f32..=4000.0),
        steps in vec(0.1f32..10.0, 1..5),
        (speed_m_s, start_s) in (within(limits::WALK_M_S), within(limits::START_S)),
        color in vector(limits::COLOR),
    ) -> Walker {
        let mut corner = Vec2::new(x_m, z_m);
        let mut way_m = vec![corner];
        for step_m in steps {
            corner.y += step_m.max(0.11);
            way_m.push(corner);
        }
        Walker { way_m, speed_m_s, start_s, color }
    }
}

prop_compose! {
    fn litter()(
        (x_m, z_m, along_m, across_m) in (
            within(limits::CENTER_M), within(limits::CENTER_M), within(limits::LITTER_SIZE_M), within(limits::LITTER_SIZE_M)
        ),
        // Larger ones have more leaves than slots, where leaves are small.
        leaf_area_index in 0.0f32..=1e-4,
        (bulk_density_kg_m3, friction, restitution) in
            (within(limits::BULK_DENSITY_KG_M3), within(limits::FRICTION), within(limits::RESTITUTION)),
        (least_raised_deg, raised_spread) in (within(limits::RAISED_DEG), 0.0f32..=1.0),
        (moisture, adhesion_n_m2, float_hours, still) in
            (within(limits::MOISTURE), within(limits::ADHESION_N_M2), within(limits::FLOAT_HOURS), any::<bool>()),
    ) -> Litter {
        Litter {
            center_m: Vec2::new(x_m, z_m),
            size_m: Vec2::new(along_m, across_m),
            raised_deg: (least_raised_deg, least_raised_deg + raised_spread * (limits::RAISED_DEG.high - least_raised_deg)),
            leaf_area_index, bulk_density_kg_m3, friction, restitution, moisture, adhesion_n_m2, float_hours, still,
        }
    }
}

/// Numbers about a mean, none below a half or above three times of it.
fn spread(mean: Limit<f32>) -> impl Strategy<Value = Spread> {
    (within(mean), 0.0f32..0.5, 0u32..4).prop_map(|(mean, share, kind)| match kind {
        0 => Spread::Constant(mean),
        1 => Spread::Uniform(mean, share * mean),
        2 => Spread::Cubic(mean, share * mean),
        _ => Spread::Normal(mean, share * mean / NORMAL_REACH),
    })
}

/// A third of a range on a logarithmic scale, so that spreads stay within it.
fn inner(limit: Limit<f32>) -> Limit<f32> {
    Limit { low: limit.low * 2.0, high: limit.high / 3.0, unit: limit.unit }
}

fn particle_shape() -> impl Strategy<Value = ParticleShape> {
    let at = || vector(limits::PARTICLE_AT_M);
    let radius = || within(limits::RADIUS_M);
    let axis = || Just(Vec3::new(1.0, -2.0, 0.5));
    prop_oneof![
        (at(), vector(limits::HALF_EXTENT_M))
            .prop_map(|(center_m, half_extent_m)| ParticleShape::Box { center_m, half_extent_m }),
        (at(), radius(), axis()).prop_map(|(center_m, radius_m, axis)| ParticleShape::Disc {
            center_m,
            radius_m,
            axis
        }),
        (at(), radius(), axis()).prop_map(|(center_m, radius_m, axis)| ParticleShape::Ring {
            center_m,
            radius_m,
            axis
        }),
        (at(), radius(), any::<bool>()).prop_map(|(center_m, radius_m, hollow)| ParticleShape::Sphere {
            center_m,
            radius_m,
            hollow
        }),
        (vector(Limit { low: -100.0, high: 100.0, unit: "m" }), radius()).prop_map(|(tip_m, radius_m)| {
            ParticleShape::Cone { tip_m, base_m: tip_m + Vec3::Y, radius_m }
        }),
        (at(), radius(), limits::FEET.low..=limits::FEET.high)
            .prop_map(|(center_m, radius_m, feet)| ParticleShape::Feet { center_m, radius_m, feet }),
        (at(), at()).prop_map(|(from_m, to_m)| ParticleShape::Line { from_m, to_m }),
    ]
}

prop_compose! {
    fn look()(
        kind in prop_oneof![
            select(vec![LookKind::Dot, LookKind::Splat, LookKind::Glow, LookKind::Hidden]),
            (within(limits::BLOB_RADIUS_M), within(limits::BLOB_THRESHOLD))
                .prop_map(|(radius_m, threshold)| LookKind::Blobs { radius_m, threshold }),
        ],
        color in option::of((vector(limits::COLOR), vector(limits::COLOR))),
        (opacity, size, temperature_k) in
            (maybe(limits::OPACITY), maybe(limits::SIZE_OVER_AGE), maybe(limits::TEMPERATURE_K)),
        (brightness_kcd_m2, blink_s, streak, layer) in
            (within(limits::PARTICLE_BRIGHTNESS_KCD_M2), maybe(limits::BLINK_S), any::<bool>(), 0u32..=15),
    ) -> Look {
        let color = color.map_or(Vec::new(), |(first, last)| vec![(0.0, first), (1.0, last)]);
        let curve = |value: Option<f32>| value.map_or(Vec::new(), |value| vec![(0.25, value)]);
        let blink_s = blink_s.filter(|_| kind == LookKind::Glow);
        let is_solid = matches!(kind, LookKind::Blobs { .. });
        let (opacity, streak) = (opacity.filter(|_| !is_solid), streak && !is_solid);
        let layer = if is_solid { 0 } else { layer };
        let temperature_k = curve(temperature_k.filter(|_| kind == LookKind::Glow));
        Look {
            kind,
            color,
            temperature_k,
            opacity: curve(opacity),
            size: curve(size),
            brightness_kcd_m2,
            blink_s,
            lights: false,
            streak,
            ribbon: None,
            layer,
        }
    }
}

fn nest() -> impl Strategy<Value = Option<Nest>> {
    let on = prop_oneof![
        Just(ParticleEvent::Birth),
        Just(ParticleEvent::Death),
        Just(ParticleEvent::Hit),
        (1u32..200).prop_map(|steps| ParticleEvent::Every { steps }),
    ];
    let space = select(vec![Space::World, Space::Local]);
    let nest = (on, 1u32..=8, within(limits::INHERIT), within(limits::RADIUS_M), space);
    option::of(nest.prop_map(|(on, fan, inherit, radius_m, space)| Nest {
        of: String::new(),
        on,
        fan,
        inherit,
        radius_m,
        space,
    }))
}

/// Names populations, and lets each that may be be born of the one before it.
fn join(particles: &mut [Particles], dt_s: f32) {
    for index in 0..particles.len() {
        particles[index].name = format!("{index}");
        let Some(mut nest) = particles[index].nest.take().filter(|_| index > 0) else { continue };
        let parents = &particles[index - 1];
        nest.of.clone_from(&parents.name);
        let life_s = particles[index].life_s.map_or(0.0, Spread::highest);
        let rounds = match nest.on {
            // With slots for all that live at once.
            ParticleEvent::Every { steps } => (2..50u16)
                .find(|&rounds| life_s < f32::from(rounds - 2) * dt_s * steps as f32)
                .map_or(1, u32::from),
            _ => 1,
        };
        // With samples of their ways, children could be too many for those behind them.
        let look = Look { ribbon: None, ..particles[index].look.clone() };
        let child = Particles {
            count: parents.count * nest.fan * rounds,
            nest: Some(nest),
            history: None,
            look,
            ..particles[index].clone()
        };
        let joined = Scene {
            dt_s,
            particles: [&particles[..index], std::slice::from_ref(&child)].concat(),
            ..Scene::default()
        };
        if joined.validate("random").is_ok() {
            particles[index] = child;
        }
    }
}

prop_compose! {
    /// Names, and those of parents, are set later.
    fn particles()(
        from in particle_shape(),
        direction in prop_oneof![
            Just(Direction::Outward),
            Just(Direction::Around { axis: Vec3::new(0.5, 1.0, -0.25) }),
            within(limits::HALF_ANGLE_DEG)
                .prop_map(|half_angle_deg| Direction::Cone { axis: Vec3::new(0.5, 1.0, -0.25), half_angle_deg }),
        ],
        (per_s, start_s, kind) in (0.001f32..100.0, -100.0f32..86_400.0, 0u32..3),
        speed_m_s in spread(inner(limits::PARTICLE_SPEED_M_S)),
        life_s in spread(Limit { low: 0.01, high: 10.0, unit: "s" }),
        size_m in spread(inner(limits::PARTICLE_SIZE_M)),
        density_kg_m3 in within(limits::PARTICLE_DENSITY_KG_M3),
        air in prop_oneof![
            Just(Air::Vacuum), Just(Air::Stokes), Just(Air::Massless),
            spread(inner(limits::AIR_TIME_S)).prop_map(|time_s| Air::Linear { time_s }),
            spread(inner(limits::SETTLING_M_S)).prop_map(|m_s| Air::Settling { m_s }),
            within(limits::PARTICLE_DRAG).prop_map(|drag| Air::Quadratic { drag }),
        ],
        meets in prop_oneof![
            Just(Meets::Nothing), Just(Meets::Die), Just(Meets::Stick),
            (within(limits::RESTITUTION), within(limits::COULOMB)).prop_map(|(restitution, friction)| {
                Meets::Bounce { restitution, friction: ObjectFriction::Coulomb(friction) }
            }),
        ],
        dies in prop_oneof![
            Just(None),
            within(limits::BELOW).prop_map(|height_m| Some(Bounds::Below(height_m))),
            (vector(limits::CENTER_M), vector(limits::HALF_EXTENT_M))
                .prop_map(|(center_m, half_extent_m)| Some(Bounds::Outside { center_m, half_extent_m })),
            (vector(limits::CENTER_M), vector(limits::THROUGH_M))
                .prop_map(|(center_m, half_extent_m)| Some(Bounds::Through { center_m, half_extent_m })),
        ],
        (mut look, nest) in (look(), nest()),
        (history, ribbon) in (
            option::of((2u32..=8, 1u32..=240)),
            option::of((within(limits::RIBBON_WIDTH), any::<bool>())),
        ),
    ) -> Particles {
        // Stokes' law holds for what is small.
        let size_m = if air == Air::Stokes { Spread::Constant(1e-5) } else { size_m };
        let meets = if air == Air::Massless { Meets::Die } else { meets };
        let release = match kind {
            0 => ParticleRelease::Burst { at_s: start_s.max(0.0) },
            1 => ParticleRelease::Rate { per_s, from_s: start_s },
            _ => ParticleRelease::Poisson { per_s, from_s: start_s },
        };
        let history = history.map(|(samples, every_steps)| History { samples, every_steps });
        let has_ribbons = history.is_some() && matches!(look.kind, LookKind::Dot | LookKind::Splat | LookKind::Glow);
        look.ribbon = ribbon.filter(|_| has_ribbons).map(|(width, alone)| Ribbon { width, alone });
        // As many as blobs may be.
        let count = if matches!(look.kind, LookKind::Blobs { .. }) { MAX_BLOBS } else { 10_000 };
        Particles {
            name: String::new(), count, nest, from, direction, release, speed_m_s, life_s: Some(life_s), size_m,
            density_kg_m3, gravity: 1.0, charge_c_kg: 1.0, air, feels: Vec::new(), meets, dies, history, look,
        }
    }
}

prop_compose! {
    pub(super) fn any_scene()(
        name in "[^\\p{Cc}]{0,30}",
        seed in any::<u64>(),
        dt_s in 0.005f32..0.01,
        (fall_speed, rotation_speed, gravity_m_s2) in
            (within(limits::FALL_SPEED), within(limits::ROTATION_SPEED), 0.5f32..=STANDARD_GRAVITY_M_S2),
        mut species in vec(species(), 1..5),
        mut sources in vec(source(), 1..=MAX_SOURCES),
        (mut tree_kinds, mut trees) in (vec(tree_kind(), 0..4), vec(tree(), 0..6)),
        sway in select(vec![SwayScheme::Articulated, SwayScheme::Quigley, SwayScheme::OliapuramKumar]),
        sway_every in 1..=2u32,
        (autumn, regrow_after_s, weather) in
            (within(limits::AUTUMN), maybe(limits::REGROW_AFTER_S), option::of(weather())),
        wind in wind(),
        ground in (-4.0f32..=4.0, within(limits::FRICTION), within(limits::SURFACE_ROUGHNESS_M), option::of(terrain()), maybe(limits::HEIGHT_M), option::of(litter()))
            .prop_map(|(height_m, friction, surface_roughness_m, terrain, water, litter)| {
                let water = water.map(|height_m| Water { height_m });
                Ground { height_m, friction, surface_roughness_m, terrain, water, litter }
            }),
        view in view(),
        (mut objects, mut walkers, mut particles) in
            (vec(object(), 0..4), vec(walker(), 0..2), vec(particles(), 0..3)),
    ) -> Scene {
        for (index, species) in species.iter_mut().enumerate() {
            species.name = format!("{index} {}", species.name);
        }
        for source in &mut sources {
            source.species.truncate(species.len());
            for (share, species) in source.species.iter_mut().zip(&species) {
                share.species.clone_from(&species.name);
            }
        }
        for (index, kind) in tree_kinds.iter_mut().enumerate() {
            kind.name = format!("{index} {}", kind.name);
            if let Some(name) = &mut kind.foliage.species {
                name.clone_from(&species[index % species.len()].name);
            }
        }
        for (tree, kind) in trees.iter_mut().zip(&tree_kinds) {
            tree.kind.clone_from(&kind.name);
        }
        if ground.litter.is_none() {
            objects.clear();
            walkers.clear();
        }
        join(&mut particles, dt_s);
        let mut scene = Scene {
            name, seed, dt_s, fall_speed, rotation_speed, gravity_m_s2, species, sources, tree_kinds, trees, sway, sway_every, autumn, regrow_after_s, wind, ground,
            weather, objects, walkers, particles, forces: Vec::new(), view,
        };
        // Hills no deeper, steps no shorter, and at last leaves no slower, than there is time to fall.
        while scene.validate("random").is_err() {
            match &mut scene.ground.terrain {
                Some(terrain) if terrain.relief_m > 0.01 => terrain.relief_m *= 0.5,
                _ if scene.dt_s < 0.009 => {
                    scene.dt_s *= 1.1;
                    join(&mut scene.particles, scene.dt_s);
                }
                _ if scene.species.iter().any(|species| species.speed_variation > 0.0) => {
                    scene.species.iter_mut().for_each(|species| species.speed_variation = 0.0);
                }
                _ => break,
            }
        }
        scene
    }
}
