// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random inputs and random worlds. One file, because every world is another one with something more in it.

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use windfall_core::motion::Primitive;
use windfall_core::scene::{
    Aerodynamics, Air, Bounds, Burning, ConeShape, Direction, FlightModel, Foliage, Force, ForceCarriers,
    ForceKind, Gusts, History, Hold, Jet, JetKey, Litter, MeanSpeed, Meets, MotionParameters, Nest, Object,
    ObjectFriction, ObjectKey, ObjectMotion, ObjectShape, ParticleEvent, ParticleRelease, ParticleShape,
    Particles, PetioleRod, Planform, Plume, PlumeKey, Profile, Release, Scene, Share, Source, SourceShape,
    Space, Species, Spread, SwirlProfile, Terrain, Tree, TreeKind, Turbulence, Vortex, VortexProfile, Walker,
    Water, Weather, WindParameters,
};

use crate::functions::Input;
use crate::runner::{NO_WORDS, Words};

/// Cases for a function: every word as its input says.
pub fn cases(inputs: &'static [Input], count: usize) -> impl Strategy<Value = Vec<Words>> {
    let width: usize = inputs.iter().map(|input| input.width()).sum();
    assert!(width <= NO_WORDS.len(), "a case holds {} words", NO_WORDS.len());
    proptest::collection::vec(any::<u32>(), count * width)
        .prop_map(move |raw| raw.chunks_exact(width).map(|raw| shape(inputs, raw)).collect())
}

fn shape(inputs: &[Input], raw: &[u32]) -> Words {
    let mut words = NO_WORDS;
    let inputs = inputs.iter().flat_map(|input| std::iter::repeat_n(*input, input.width()));
    for ((word, input), raw) in words.iter_mut().zip(inputs).zip(raw) {
        let unit = f64::from(*raw) / f64::from(u32::MAX);
        #[expect(clippy::cast_possible_truncation, reason = "inputs are single precision")]
        let between =
            |low: f32, high: f32| (f64::from(low) + unit * (f64::from(high) - f64::from(low))) as f32;
        *word = match input {
            Input::Word => *raw,
            Input::Below(bound) => raw % bound,
            Input::Float(low, high) | Input::Floats(_, low, high) => between(low, high).to_bits(),
            Input::Scale(low, high) => 10f32.powf(between(low, high)).to_bits(),
        };
    }
    words
}

/// A fan in the air that turns down to the ground.
pub fn jet() -> Jet {
    let key = |time_s, x, y, speed_m_s| JetKey {
        time_s,
        at_m: Vec3::new(-6.0, 2.0, 1.0),
        toward_m: Vec3::new(x, y, 0.0),
        speed_m_s,
    };
    Jet {
        nozzle_m: 2.0,
        keys: vec![key(0.0, 4.0, 2.5, 0.0), key(2.0, 4.0, 1.0, 5.0), key(9.0, -5.0, 0.0, 4.0)],
    }
}

/// A fire that grows, beside the middle of the scene.
pub fn plume() -> Plume {
    let keys = vec![PlumeKey { time_s: 0.0, power_kw: 5.0 }, PlumeKey { time_s: 4.0, power_kw: 400.0 }];
    Plume {
        name: "fire".into(),
        at_m: Vec3::new(1.0, 0.2, -1.5),
        base_radius_m: 0.6,
        keys,
        ..Plume::default()
    }
}

/// A scene with every kind of source, gusts, turbulence, a vortex and two species; small enough to build in no time.
pub fn varied_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let species = |name: &str, size_m, areal_density_kg_m2| Species {
        name: name.into(),
        size_m,
        areal_density_kg_m2,
        ..Species::default()
    };
    let third = (leaves / 3).max(1);
    let source = |shape, count, release, recycle_after_s| Source {
        shape,
        count,
        release,
        recycle_after_s,
        species: vec![
            Share { species: "broad".into(), weight: 2 },
            Share { species: "slight".into(), weight: 1 },
        ],
    };
    Scene {
        name: "varied".into(),
        seed,
        dt_s,
        species: vec![species("broad", 0.09, 0.07), species("slight", 0.05, 0.04)],
        sources: vec![
            source(
                SourceShape::Box {
                    center_m: Vec3::new(0.0, 6.0, 0.0),
                    half_extent_m: Vec3::new(8.0, 3.0, 8.0),
                },
                third,
                Release::Burst { at_s: 0.0 },
                None,
            ),
            source(
                SourceShape::Disc { center_m: Vec3::new(-4.0, 7.0, 3.0), radius_m: 3.0 },
                third,
                Release::Rate { per_s: f64_as_f32(f64::from(third) / 12.0), from_s: -6.0 },
                Some(12.0),
            ),
            source(
                SourceShape::Sphere { center_m: Vec3::new(5.0, 6.0, -2.0), radius_m: 2.5 },
                leaves.saturating_sub(2 * third).max(1),
                Release::Rate { per_s: f64_as_f32(f64::from(third) / 10.0), from_s: 0.0 },
                Some(8.0),
            ),
        ],
        wind: WindParameters {
            direction_deg: 30.0,
            speed: MeanSpeed::MetresPerSecond(speed_m_s),
            profile: Profile::Power { exponent: 0.22 },
            gusts: Gusts { strength: 0.5, interval_s: 4.0 },
            turbulence: Turbulence { intensity: 0.25, ..Turbulence::default() },
            vortices: vec![Vortex {
                center_m: Vec3::new(2.0, 0.0, 2.0),
                axis: Vec3::new(0.1, 1.0, 0.0),
                circulation_m2_s: 2.0,
                core_m: 1.5,
                axial_m_s: 0.5,
                drift_m_s: Vec3::new(0.2, 0.0, 0.1),
                profile: VortexProfile::Kaufmann,
                spline_m: Vec::new(),
            }],
            ..WindParameters::default()
        },
        ..Scene::default()
    }
}

/// The same scene with trees of several kinds and ages in it, late enough in autumn that leaves come off.
pub fn wooded_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = varied_scene(seed, leaves, speed_m_s, dt_s);
    let tree = |kind: &str, at_m, age, number, leaves| Tree {
        kind: kind.into(),
        at_m,
        age,
        number,
        leaves,
        ..Tree::default()
    };
    scene.trees = vec![
        tree("maple", [-6.0, 2.0], 1.0, 1, 700),
        tree("birch", [9.0, -4.0], 0.5, 2, 500),
        tree("bush", [2.0, 5.0], 1.0, 3, 300),
        tree("weed", [-1.0, 4.0], 0.3, 4, 20),
        tree("oak", [-14.0, -9.0], 0.8, 5, 600),
        tree("berry-bush", [4.0, -8.0], 0.9, 6, 100),
    ];
    scene.autumn = 0.72;
    scene.regrow_after_s = Some(6.0);
    scene
}

/// The same scene with trees, and with bodies: all that is slight flies, and a third species that is twisted and curled.
pub fn flying_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = wooded_scene(seed, leaves, speed_m_s, dt_s);
    scene.species[1].flight = FlightModel::Aerodynamic(Aerodynamics::default());
    let crooked = Aerodynamics {
        planform: Some(Planform { aspect: 1.8, extent: 1.05 }),
        petiole: Some(PetioleRod { base: 1.2, length: 1.5, mass: 0.2, droop_deg: 30.0 }),
        moisture: 0.5,
        mass_offset: (-0.1, 0.05),
        curl: 0.15,
        twist: 0.3,
        gyration: (0.4, 0.6),
        edge_drag: 0.1,
        pitch_damping: 0.2,
        irregularity: 0.1,
        hold: Hold::EdgeOn,
        tilt_deg: 20.0,
    };
    scene.species.push(Species {
        name: "crooked".into(),
        size_variation: 0.3,
        flight: FlightModel::Aerodynamic(crooked),
        ..Species::default()
    });
    for source in &mut scene.sources {
        source.species.push(Share { species: "crooked".into(), weight: 1 });
    }
    scene.tree_kinds = vec![TreeKind {
        name: "tree of bodies".into(),
        foliage: Foliage { species: Some("crooked".into()), ..Foliage::default() },
        ..TreeKind::default()
    }];
    scene.trees[0].kind = "tree of bodies".into();
    scene
}

/// The same scene on steep hills with a pond between them.
pub fn hilly_scene(mut scene: Scene) -> Scene {
    let hills = Terrain { seed: 7, edge_m: 64.0, relief_m: 9.0, levels: 6, noise: 0.6, ..Terrain::default() };
    scene.ground.terrain = Some(hills);
    scene.ground.water = Some(Water { height_m: 1.5 });
    scene
}

/// A bed of leaves of both flight models under a gusty wind, on which others fall that are released again: leaves slide, tumble, hop
/// and come to rest, on one another and at the foot of a heap.
pub fn littered_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = varied_scene(seed, leaves, speed_m_s, dt_s);
    scene.species[1].flight = FlightModel::Aerodynamic(Aerodynamics::default());
    scene.ground.surface_roughness_m = 0.001;
    scene.ground.litter =
        Some(Litter { size_m: Vec2::new(14.0, 12.0), leaf_area_index: 0.08, ..Litter::default() });
    scene.sources.push(Source {
        shape: SourceShape::Disc { center_m: Vec3::new(2.0, 0.6, 1.0), radius_m: 0.1 },
        count: (leaves / 3).max(1),
        release: Release::Rate { per_s: f64_as_f32(f64::from(leaves) / 3.0), from_s: -1.0 },
        recycle_after_s: Some(9.0),
        species: Vec::new(),
    });
    scene
}

/// A scene with litter of dry leaves, a fire beneath some of it, and `leaves` leaves in the air. What burns feeds a second fire; a glow is where
/// it burns, and embers are born of that.
pub fn burning_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = littered_scene(seed, leaves, speed_m_s, dt_s);
    scene.sources.iter_mut().for_each(|source| source.recycle_after_s = None);
    scene.regrow_after_s = None;
    scene.ground.litter =
        Some(Litter { size_m: Vec2::new(8.0, 7.0), leaf_area_index: 0.9, ..Litter::default() });
    let burning = Burning { ignition_c: (200.0, 300.0), front_mm_s: 20.0, ..Burning::default() };
    scene.species.iter_mut().for_each(|species| species.burns = Some(burning));
    let at_m = Vec3::new(1.0, 0.0, -1.5);
    scene.wind.plumes = vec![
        Plume { keys: vec![PlumeKey { time_s: 0.0, power_kw: 6.0 }], at_m, base_radius_m: 0.8, ..plume() },
        Plume { name: "fed".into(), fed_within_m: Some(2.5), keys: Vec::new(), at_m, ..plume() },
    ];
    let on_leaves = Particles {
        name: "glow".into(),
        count: scene.leaf_count(),
        release: ParticleRelease::BurningLeaves,
        ..Particles::default()
    };
    let embers = Particles {
        name: "embers".into(),
        count: 2 * scene.leaf_count(),
        nest: Some(Nest {
            of: "glow".into(),
            on: ParticleEvent::Every { steps: 30 },
            inherit: 0.5,
            ..Nest::default()
        }),
        life_s: Some(Spread::Constant(0.4)),
        ..Particles::default()
    };
    scene.particles = vec![on_leaves, embers];
    scene
}

/// A scene with living litter, a jet, `leaves` leaves in the air and solid things of every shape among them, still and moving, and somebody
/// who walks there.
pub fn obstructed_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = littered_scene(seed, leaves, speed_m_s, dt_s);
    // So weak that leaves still lie.
    let mut jet = jet();
    jet.keys.iter_mut().for_each(|key| key.speed_m_s *= 0.2);
    scene.wind.jets = vec![jet];
    if let Some(source) = scene.sources.last_mut() {
        source.shape = SourceShape::Disc { center_m: Vec3::new(0.5, 1.5, 0.5), radius_m: 1.5 };
    }
    let solid = |shape, x, y, z| Object { shape, at_m: Vec3::new(x, y, z), ..Object::default() };
    let key = |time_s, x, y, z| ObjectKey { time_s, moved_m: Vec3::new(x, y, z), turned_deg: 40.0 * time_s };
    scene.objects = vec![
        Object {
            heading_deg: 20.0,
            ..solid(ObjectShape::Box { size_m: Vec3::new(1.6, 0.45, 1.2) }, 0.5, 0.225, 0.3)
        },
        Object {
            tilt_deg: 25.0,
            ..solid(ObjectShape::Box { size_m: Vec3::new(2.0, 0.1, 2.0) }, -2.0, 0.6, 1.0)
        },
        solid(ObjectShape::Cylinder { radius_m: 0.5, height_m: 2.0 }, 2.5, 1.0, 1.5),
        Object {
            friction: ObjectFriction::Loss(0.3),
            restitution: 0.6,
            ..solid(ObjectShape::Sphere { radius_m: 0.7 }, 2.0, 0.5, -1.0)
        },
        Object {
            tilt_deg: 80.0,
            ..solid(ObjectShape::Capsule { radius_m: 0.2, length_m: 1.5 }, -1.0, 0.3, -2.0)
        },
        Object {
            motion: ObjectMotion::Path(vec![
                key(0.0, 0.0, 0.0, 0.0),
                key(2.0, 4.0, 0.3, 1.0),
                key(6.0, -1.0, 0.0, 4.0),
            ]),
            ..solid(ObjectShape::Capsule { radius_m: 0.25, length_m: 0.6 }, -2.0, 0.5, -2.0)
        },
        Object { heading_deg: -30.0, tilt_deg: 15.0, ..solid(stone(), -0.5, 0.3, 2.2) },
        Object { tilt_deg: 70.0, ..solid(torus(1.2), 3.0, 0.6, -1.5) },
        Object {
            friction: ObjectFriction::Loss(0.1),
            motion: ObjectMotion::Path(vec![key(0.0, 0.0, 0.0, 0.0), key(4.0, -2.0, 0.4, 1.5)]),
            ..solid(torus(1.0), 2.5, 0.4, 2.0)
        },
        Object {
            motion: ObjectMotion::Path(vec![key(0.0, 0.0, 0.0, 0.0), key(3.0, 1.0, 0.2, -2.5)]),
            ..solid(stone(), -3.0, 0.4, 1.0)
        },
    ];
    scene.walkers = vec![Walker {
        way_m: vec![Vec2::new(-4.0, 2.0), Vec2::new(3.0, 0.5), Vec2::new(4.0, -3.0)],
        ..Walker::default()
    }];
    scene
}

/// A stone with seven corners.
pub fn stone() -> ObjectShape {
    let corners_m = [
        [0.4, -0.3, 0.3],
        [-0.4, -0.3, 0.35],
        [0.1, -0.35, -0.5],
        [0.5, 0.2, 0.1],
        [-0.5, 0.15, -0.1],
        [0.0, 0.4, 0.25],
        [0.1, 0.3, -0.4],
    ];
    ObjectShape::Polyhedron { corners_m: corners_m.map(Vec3::from).to_vec() }
}

/// A torus out of a file, with radii of 0.5 m and 0.15 m times a scale, about y.
pub fn torus(scale: f32) -> ObjectShape {
    ObjectShape::Mesh { file: concat!(env!("CARGO_MANIFEST_DIR"), "/data/torus.gltf").into(), scale }
}

/// The same things in and around a pond, on which leaves float for a few seconds before they sink.
pub fn pond_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = obstructed_scene(seed, leaves, speed_m_s, dt_s);
    let hollow = Terrain { edge_m: 32.0, relief_m: 3.0, levels: 6, noise: 0.2, ..Terrain::default() };
    scene.ground.terrain = Some(hollow);
    scene.ground.water = Some(Water { height_m: 0.2 });
    scene.ground.litter = scene.ground.litter.map(|litter| Litter { float_hours: 0.002, ..litter });
    scene
}

/// Level ground half of the time, otherwise hills from rolling to jagged; either with water or without.
fn ground() -> impl Strategy<Value = (Option<Terrain>, Option<Water>)> {
    let rough = (0f32..1.0, 0f32..0.5, 0u32..4);
    let terrain = (any::<u64>(), 16f32..400.0, 0f32..30.0, 2u32..8, rough).prop_map(
        |(seed, edge_m, relief_m, levels, (noise, pulled, smoothing))| Terrain {
            seed,
            edge_m,
            relief_m,
            levels,
            noise,
            pulled,
            smoothing,
        },
    );
    let water = (-1f32..4.0).prop_map(|height_m| Water { height_m });
    (proptest::option::of(terrain), proptest::option::of(water))
}

/// The same scene in a wind without chaos: profile and gusts, but eddies of tens of metres, no vortex and no jet, so that two
/// leaves a rounding error apart stay about that far apart.
pub fn smooth_scene(seed: u64, leaves: u32, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = varied_scene(seed, leaves, speed_m_s, dt_s);
    scene.wind.turbulence = Turbulence { intensity: 0.1, cell_m: 10.0, ..Turbulence::default() };
    scene.wind.vortices.clear();
    scene.wind.jets.clear();
    scene.wind.plumes.clear();
    scene
}

/// The same scene with leaves of two more species, which wind down on bowls and cones.
pub fn winding_scene(mut scene: Scene) -> Scene {
    for (name, shape) in [("on a bowl", ConeShape::Bowl), ("on a cone", ConeShape::Cone)] {
        let motion = MotionParameters {
            cone_shape: Some(shape),
            cone_depth_m: Some(2.0),
            corner_swing_deg: Some(40.0),
            ..MotionParameters::default()
        };
        let species =
            Species { name: name.into(), start: Primitive::ConeSpiral, motion, ..Species::default() };
        scene.species.push(species);
        for source in scene.sources.iter_mut().filter(|source| !source.species.is_empty()) {
            source.species.push(Share { species: name.into(), weight: 2 });
        }
    }
    scene
}

#[expect(clippy::cast_possible_truncation, reason = "scene numbers are single precision")]
fn f64_as_f32(value: f64) -> f32 {
    value as f32
}

/// A tree small enough that a world of them is stepped in no time: up to a few hundred segments.
fn small_tree() -> impl Strategy<Value = Tree> {
    let kind = prop_oneof![Just(("bush", 0.3)), Just(("weed", 0.5)), Just(("maple", 0.15))];
    let place = (-20f32..20.0, -20f32..20.0, -180f32..180.0);
    (kind, 0.8f32..1.2, place, 0u32..1000, 0u32..150).prop_map(
        |((kind, age), older, (x, z, heading_deg), number, leaves)| Tree {
            kind: kind.into(),
            at_m: [x, z],
            height_m: None,
            age: age * older,
            heading_deg,
            number,
            leaves,
        },
    )
}

/// No trees half of the time, otherwise a few, in a season, coming into leaf again or not.
fn woods() -> impl Strategy<Value = (Vec<Tree>, f32, Option<f32>)> {
    let trees = prop_oneof![Just(Vec::new()), proptest::collection::vec(small_tree(), 1..4)];
    (trees, 0f32..1.0, proptest::option::of(1f32..6.0))
}

/// A body of any kind.
fn aerodynamics() -> impl Strategy<Value = Aerodynamics> {
    let planform = proptest::option::of((0.3f32..3.0, 1.0f32..1.3));
    let rod = proptest::option::of((0.5f32..1.5, 0f32..2.0, 0f32..0.3, -40f32..40.0));
    let hold = prop_oneof![Just(Hold::Random), Just(Hold::Broadside), Just(Hold::EdgeOn)];
    let bent = (-0.3f32..0.3, -0.3f32..0.3, -0.5f32..0.5, -1f32..1.0);
    (planform, rod, 0f32..2.0, bent, 0f32..0.2, hold, 0f32..90.0).prop_map(
        |(planform, rod, moisture, (along, across, curl, twist), irregularity, hold, tilt_deg)| {
            Aerodynamics {
                planform: planform.map(|(aspect, extent)| Planform { aspect, extent }),
                petiole: rod.map(|(base, length, mass, droop_deg)| PetioleRod {
                    base,
                    length,
                    mass,
                    droop_deg,
                }),
                moisture,
                mass_offset: (along, across),
                curl,
                twist,
                irregularity,
                hold,
                tilt_deg,
                ..Aerodynamics::default()
            }
        },
    )
}

/// Random scenes: varied ones, with all that can differ drawn at random, trees in half of them, bodies in half, hills in
/// half.
pub fn scenes(leaves: std::ops::Range<u32>) -> impl Strategy<Value = Scene> {
    let numbers = (
        any::<u64>(),
        leaves,
        0f32..20.0,
        prop_oneof![Just(1.0 / 60.0), Just(1.0 / 30.0), Just(1.0 / 240.0)],
    );
    let motion = (0.3f32..2.5, 0.2f32..1.5, 0usize..Primitive::ALL.len(), 0f32..0.25, 0.05f32..2.0);
    let place = (-200f32..200.0, 0.1f32..1.0, 0usize..3, (0usize..2, 0usize..2, 0usize..2));
    (numbers, motion, place, woods(), proptest::option::of(aerodynamics()), ground())
        .prop_map(|((seed, leaves, speed, dt), motion, place, woods, body, ground)| {
            let (fall_speed, rotation_speed, start, variation, friction) = motion;
            let (offset, intensity, profile, (vortices, jets, plumes)) = place;
            let mut scene = varied_scene(seed, leaves, speed, dt);
            (scene.trees, scene.autumn, scene.regrow_after_s) = woods;
            scene.fall_speed = fall_speed;
            scene.rotation_speed = rotation_speed;
            scene.species[0].start = Primitive::ALL[start];
            scene.species[1].size_variation = variation;
            scene.species[1].flight = body.map_or(FlightModel::Synthesis, FlightModel::Aerodynamic);
            scene.ground.friction = friction;
            (scene.ground.terrain, scene.ground.water) = ground;
            scene.wind.turbulence.intensity = intensity;
            scene.wind.profile = [
                Profile::Uniform,
                Profile::Power { exponent: 0.3 },
                Profile::Log { roughness_m: 0.05, displacement_m: 0.5 },
            ][profile];
            scene.wind.vortices.truncate(vortices);
            scene.wind.jets.truncate(jets);
            scene.wind.plumes = vec![plume(); plumes];
            for source in &mut scene.sources {
                let (SourceShape::Box { center_m, .. }
                | SourceShape::Disc { center_m, .. }
                | SourceShape::Sphere { center_m, .. }) = &mut source.shape;
                center_m.x += offset;
            }
            scene
        })
        .prop_filter("valid", |scene| scene.validate("random").is_ok())
}

/// Particles of every kind of shape, birth, drag, force, contact and event of a parent among solid things, some on hills.
pub fn particle_scene(seed: u64, speed_m_s: f32, dt_s: f32) -> Scene {
    let mut scene = obstructed_scene(seed, 64, speed_m_s, dt_s);
    let axis = Vec3::new(0.4, 1.0, -0.2);
    let force = |name: &str, of: ForceKind| Force { name: name.into(), of, carried_by: None };
    scene.forces = vec![
        force("sun", ForceKind::Attract { at_m: Vec3::new(0.0, 3.0, 0.0), gm_m3_s2: 4.0, softening_m: 0.2 }),
        force("noise", ForceKind::Noise { m_s2: 3.0, cell_m: 0.5 }),
        force(
            "field",
            ForceKind::Lorentz { b_t: Vec3::new(0.5, 1.5, 0.0), e_v_m: Vec3::new(0.2, 0.0, -0.4) },
        ),
        force("spiral", ForceKind::Spiral { rad_s: 4.0, axis }),
        force(
            "swirl",
            ForceKind::Swirl {
                at_m: Vec3::new(1.0, 0.0, 0.5),
                axis,
                rate_rad_s: 2.5,
                swirl_radius_m: 1.5,
                profile: SwirlProfile::Power { alpha: 1 },
            },
        ),
        force(
            "whirl",
            ForceKind::Swirl {
                at_m: Vec3::new(-1.0, 0.0, 0.5),
                axis: Vec3::Y,
                rate_rad_s: -5.0,
                swirl_radius_m: 2.5,
                profile: SwirlProfile::Compact { d: 0.5 },
            },
        ),
    ];
    let carried = |name: &str, of: ForceKind, strength: &[(f32, f32)]| {
        let carried_by = Some(ForceCarriers { of: "8".into(), strength: strength.to_vec() });
        Force { name: name.into(), of, carried_by }
    };
    scene.forces.extend([
        carried(
            "pull",
            ForceKind::Attract { at_m: Vec3::new(0.0, 0.2, 0.0), gm_m3_s2: 0.5, softening_m: 0.3 },
            &[(0.1, 0.2), (0.5, 1.0), (1.0, -0.5)],
        ),
        carried(
            "devil",
            ForceKind::Swirl {
                at_m: Vec3::ZERO,
                axis: Vec3::Y,
                rate_rad_s: 4.0,
                swirl_radius_m: 1.0,
                profile: SwirlProfile::Compact { d: 0.0 },
            },
            &[],
        ),
    ]);
    scene.forces.push(force("others", ForceKind::Mutual { gm_m3_s2: 0.02, softening_m: 0.1 }));
    // Heavy, in a thaw, and partly beside the rectangle on which it lies.
    scene.weather = Some(Weather {
        center_m: Vec2::new(1.0, -0.5),
        size_m: Vec2::new(7.0, 6.25),
        snow_mm_h: vec![(0.0, 50.0), (4.0, 20.0), (9.0, 50.0)],
        air_c: vec![(0.0, -8.0), (2.0, 30.0)],
        lying_mm: 1.5,
        lying_h: 0.0,
    });
    let bounce = |restitution: f32, friction: ObjectFriction| Meets::Bounce { restitution, friction };
    let cone = |half_angle_deg: f32| Direction::Cone { axis, half_angle_deg };
    let rate = |per_s: f32, from_s: f32| ParticleRelease::Rate { per_s, from_s };
    let high = Vec3::new(0.0, 3.0, 0.0);
    let rows = [
        Particles {
            count: 1500,
            from: ParticleShape::Feet { center_m: high, radius_m: 1.0, feet: 7 },
            direction: cone(40.0),
            release: ParticleRelease::Poisson { per_s: 400.0, from_s: -1.0 },
            speed_m_s: Spread::Normal(4.0, 1.0),
            life_s: Some(Spread::Uniform(1.6, 0.9)),
            size_m: Spread::Uniform(0.002, 0.001),
            density_kg_m3: 300.0,
            air: Air::Quadratic { drag: 1.1 },
            meets: bounce(0.45, ObjectFriction::Coulomb(0.4)),
            history: Some(History { samples: 8, every_steps: 2 }),
            ..Particles::default()
        },
        Particles {
            count: 900,
            from: ParticleShape::Box { center_m: high, half_extent_m: Vec3::new(4.0, 0.5, 4.0) },
            release: ParticleRelease::Snowfall,
            life_s: Some(Spread::Cubic(1.5, 1.0)),
            air: Air::Settling { m_s: Spread::Uniform(5.0, 1.0) },
            meets: Meets::Die,
            dies: Some(Bounds::Through { center_m: high, half_extent_m: Vec3::new(4.0, 9.0, 4.0) }),
            ..Particles::default()
        },
        Particles {
            count: 700,
            from: ParticleShape::Line { from_m: Vec3::new(-4.0, 3.0, 0.0), to_m: Vec3::new(4.0, 3.5, 1.0) },
            direction: Direction::Around { axis },
            speed_m_s: Spread::Constant(0.5),
            release: rate(90.0, -4.0),
            life_s: Some(Spread::Normal(6.0, 0.3)),
            air: Air::Settling { m_s: Spread::Constant(1.0) },
            feels: vec!["swirl".into(), "noise".into()],
            meets: Meets::Stick,
            history: Some(History { samples: 6, every_steps: 7 }),
            ..Particles::default()
        },
        Particles {
            count: 400,
            from: ParticleShape::Sphere { center_m: high, radius_m: 1.0, hollow: false },
            release: ParticleRelease::Burst { at_s: 0.0 },
            life_s: None,
            size_m: Spread::Constant(3e-5),
            air: Air::Stokes,
            dies: Some(Bounds::Outside { center_m: high, half_extent_m: Vec3::splat(3.0) }),
            ..Particles::default()
        },
        Particles {
            count: 300,
            from: ParticleShape::Ring { center_m: Vec3::new(0.0, 0.5, 0.0), radius_m: 1.0, axis: Vec3::Y },
            direction: Direction::Outward,
            release: rate(60.0, 0.0),
            life_s: Some(Spread::Constant(4.0)),
            air: Air::Massless,
            feels: vec!["whirl".into(), "devil".into()],
            history: Some(History { samples: 3, every_steps: 5 }),
            ..Particles::default()
        },
        Particles {
            count: 300,
            from: ParticleShape::Sphere { center_m: high, radius_m: 0.5, hollow: true },
            direction: Direction::Outward,
            release: ParticleRelease::Burst { at_s: 0.3 },
            speed_m_s: Spread::Constant(1.5),
            charge_c_kg: 2.0,
            air: Air::Linear { time_s: Spread::Uniform(2.0, 1.0) },
            feels: vec!["field".into(), "sun".into(), "pull".into()],
            meets: bounce(0.8, ObjectFriction::Loss(0.2)),
            ..Particles::default()
        },
        Particles {
            count: 900,
            from: ParticleShape::Cone { tip_m: high, base_m: high + axis, radius_m: 0.6 },
            direction: cone(180.0),
            release: ParticleRelease::Poisson { per_s: 120.0, from_s: 0.5 },
            speed_m_s: Spread::Uniform(30.0, 29.0),
            life_s: Some(Spread::Constant(4.0)),
            air: Air::Vacuum,
            feels: vec!["spiral".into()],
            meets: bounce(0.3, ObjectFriction::Coulomb(0.9)),
            dies: Some(Bounds::Below(-1.5)),
            ..Particles::default()
        },
        Particles {
            count: 333,
            from: ParticleShape::Sphere { center_m: high * 2.0, radius_m: 1.0, hollow: false },
            release: ParticleRelease::Burst { at_s: 0.0 },
            speed_m_s: Spread::Constant(0.2),
            gravity: 0.0,
            life_s: None,
            air: Air::Vacuum,
            feels: vec!["others".into()],
            ..Particles::default()
        },
    ];
    let rows = rows.into_iter().chain(nest_rows());
    scene.particles =
        (0..).zip(rows).map(|(number, row)| Particles { name: format!("{number}"), ..row }).collect();
    scene
}

/// Populations behind eight others that are born of others at every kind of event, over three levels; the last two go along with them.
fn nest_rows() -> [Particles; 8] {
    let nest = |of: u32, on: ParticleEvent, fan: u32, inherit: f32| {
        Some(Nest { of: of.to_string(), on, fan, inherit, radius_m: 0.05, space: Space::World })
    };
    let local = |of: u32, on: ParticleEvent| {
        Some(Nest { of: of.to_string(), on, radius_m: 0.3, space: Space::Local, ..Nest::default() })
    };
    let settling = |m_s: f32| Air::Settling { m_s: Spread::Constant(m_s) };
    [
        // Rockets.
        Particles {
            count: 60,
            from: ParticleShape::Disc { center_m: Vec3::ZERO, radius_m: 3.0, axis: Vec3::Y },
            direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 15.0 },
            release: ParticleRelease::Rate { per_s: 30.0, from_s: -3.0 },
            speed_m_s: Spread::Constant(9.0),
            life_s: Some(Spread::Uniform(0.8, 0.2)),
            air: Air::Quadratic { drag: 0.5 },
            feels: vec!["devil".into(), "pull".into()],
            ..Particles::default()
        },
        // Dust where the fast ones of the seventh population strike.
        Particles {
            count: 1800,
            nest: nest(6, ParticleEvent::Hit, 1, 0.1),
            speed_m_s: Spread::Constant(0.5),
            life_s: Some(Spread::Uniform(0.4, 0.2)),
            air: settling(0.3),
            ..Particles::default()
        },
        // Trails, which go with the air.
        Particles {
            count: 360,
            nest: nest(8, ParticleEvent::Every { steps: 3 }, 1, 0.0),
            life_s: Some(Spread::Normal(0.2, 0.01)),
            air: Air::Massless,
            meets: Meets::Nothing,
            ..Particles::default()
        },
        // Stars that bounce.
        Particles {
            count: 480,
            nest: nest(8, ParticleEvent::Death, 8, 1.0),
            speed_m_s: Spread::Uniform(4.0, 2.0),
            life_s: Some(Spread::Constant(1.1)),
            air: Air::Vacuum,
            meets: Meets::Bounce { restitution: 0.6, friction: ObjectFriction::Coulomb(0.2) },
            history: Some(History { samples: 5, every_steps: 3 }),
            ..Particles::default()
        },
        // What they throw up.
        Particles {
            count: 1440,
            nest: nest(11, ParticleEvent::Hit, 3, -0.25),
            direction: Direction::Outward,
            speed_m_s: Spread::Constant(1.0),
            life_s: Some(Spread::Constant(0.5)),
            air: settling(2.0),
            feels: vec!["noise".into()],
            ..Particles::default()
        },
        // And once more.
        Particles {
            count: 1440,
            nest: nest(12, ParticleEvent::Birth, 1, 1.0),
            life_s: Some(Spread::Constant(0.3)),
            air: Air::Vacuum,
            meets: Meets::Stick,
            ..Particles::default()
        },
        // Sparks around these stars.
        Particles {
            count: 480,
            nest: local(11, ParticleEvent::Every { steps: 22 }),
            direction: Direction::Outward,
            speed_m_s: Spread::Uniform(1.0, 0.5),
            life_s: Some(Spread::Constant(0.25)),
            air: settling(0.5),
            meets: Meets::Bounce { restitution: 0.4, friction: ObjectFriction::Coulomb(0.3) },
            history: Some(History { samples: 4, every_steps: 1 }),
            ..Particles::default()
        },
        // And around the sparks.
        Particles {
            count: 480,
            nest: local(14, ParticleEvent::Birth),
            speed_m_s: Spread::Constant(0.3),
            life_s: Some(Spread::Constant(0.1)),
            air: Air::Massless,
            ..Particles::default()
        },
    ]
}
