// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that together show every row of the panel.

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::motion::Primitive;
use windfall_core::scene::{
    Aerodynamics, Air, Bounds, Burning, CameraKey, CrownHull, Direction, Exposure, FlightModel, Focus, Force,
    ForceKind, History, Jet, JetKey, Litter, Look, LookKind, MeanSpeed, Meets, Object, ObjectFriction,
    ObjectKey, ObjectMotion, ObjectShape, ParticleFlow, ParticleRelease, ParticleShape, Particles, Planform,
    Plume, PlumeKey, Profile, Release, Ribbon, RotationModel, Share, Sky, SkyMap, SourceShape,
    SpaceColonization, Spread, SwirlProfile, Terrain, ToneMap, Tree, TreeForm, TreeKind, Vortex,
    VortexProfile, Walker, Water, Weather,
};

/// A park with one of everything that may be added to a scene.
pub(super) fn full() -> Scene {
    let tree = Tree { kind: "own".into(), leaves: 10, height_m: Some(6.0), ..Tree::default() };
    let kind = TreeKind { name: "own".into(), ..TreeKind::default() };
    let mut scene = Scene { trees: vec![tree], tree_kinds: vec![kind], ..Scene::default() };
    scene.sources[0].species = vec![Share { species: "maple".into(), weight: 2 }];
    scene.regrow_after_s = Some(50.0);
    scene.autumn = 0.4;
    scene.wind.speed = MeanSpeed::Beaufort(3);
    scene.wind.vortices = vec![Vortex {
        center_m: Vec3::ONE,
        axis: Vec3::Y,
        circulation_m2_s: 3.0,
        core_m: 1.0,
        axial_m_s: 1.0,
        drift_m_s: Vec3::X,
        profile: VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    }];
    let key = JetKey { time_s: 0.0, at_m: Vec3::Y, toward_m: Vec3::X, speed_m_s: 40.0 };
    scene.wind.jets = vec![Jet { nozzle_m: 0.1, keys: vec![key] }];
    let key = PlumeKey { time_s: 0.0, power_kw: 40.0 };
    scene.wind.plumes = vec![Plume { at_m: Vec3::X, keys: vec![key], ..Plume::default() }];
    scene.ground.litter = Some(Litter { leaf_area_index: 0.0, ..Litter::default() });
    scene.weather = Some(Weather::default());
    scene.objects = vec![Object::default()];
    scene.walkers = vec![Walker::default()];
    scene.particles = vec![population("first", Air::Settling { m_s: Spread::Uniform(1.0, 0.2) }, "push")];
    scene.particles[0].dies = Some(Bounds::Below(-1.0));
    scene.forces = vec![Force {
        name: "push".into(),
        of: ForceKind::Noise { m_s2: 1.0, cell_m: 1.0 },
        carried_by: None,
    }];
    scene.ground.terrain = Some(Terrain { levels: 4, ..Terrain::default() });
    scene.ground.water = Some(Water { height_m: -0.5 });
    scene.view.path =
        vec![CameraKey { time_s: 1.0, eye_m: Vec3::ONE, target_m: Vec3::ZERO, vertical_fov_deg: 40.0 }];
    scene.view.lens.focus = Some(Focus { distance_m: 3.0, f_number: 4.0 });
    scene
}

/// A population that feels a force, with room to spare.
fn population(name: &str, air: Air, force: &str) -> Particles {
    let look = Look { color: vec![(0.0, Vec3::ONE)], ..Look::default() };
    Particles { name: name.into(), count: 5000, air, look, feels: vec![force.into()], ..Particles::default() }
}

/// The other variant of every choice.
pub(super) fn other() -> Scene {
    let mut scene = full();
    let body = Aerodynamics { planform: Some(Planform::default()), ..Aerodynamics::default() };
    scene.species[0].flight = FlightModel::Aerodynamic(body);
    scene.sources[0].shape = SourceShape::Disc { center_m: Vec3::new(0.0, 6.0, 0.0), radius_m: 3.0 };
    scene.sources[0].release = Release::Burst { at_s: 1.0 };
    scene.objects[0].shape = ObjectShape::Capsule { radius_m: 0.3, length_m: 1.0 };
    scene.objects[0].friction = ObjectFriction::Loss(0.4);
    scene.wind.profile = Profile::Log { roughness_m: 0.05, displacement_m: 0.5 };
    scene.wind.speed = MeanSpeed::MetresPerSecond(2.0);
    scene.tree_kinds[0].form = TreeForm::File("a.glb".into());
    scene.trees[0].kind = "maple".into();
    scene.view.sky = Sky::Map(SkyMap::new("a.hdr".into()));
    scene.view.lens.exposure = Exposure::Manual { ev100: 12.0 };
    scene.view.lens.tone_map = ToneMap::Reinhard { white: 3.0 };
    let one = &mut scene.particles[0];
    one.from = ParticleShape::Cone { tip_m: Vec3::Y, base_m: 2.0 * Vec3::Y, radius_m: 1.0 };
    one.air = Air::Linear { time_s: Spread::Normal(0.5, 0.1) };
    one.meets = Meets::Bounce { restitution: 0.3, friction: ObjectFriction::Loss(0.2) };
    one.release = ParticleRelease::Burst { at_s: 1.0 };
    one.dies = Some(Bounds::Outside { center_m: Vec3::Y, half_extent_m: Vec3::splat(20.0) });
    (one.look.kind, one.look.blink_s) = (LookKind::Glow, Some(2.0));
    one.history = Some(History { samples: 9, every_steps: 3 });
    one.look.ribbon = Some(Ribbon { width: 0.5, alone: false });
    one.look.opacity = vec![(0.0, 0.5), (1.0, 0.0)];
    scene.forces[0].of = ForceKind::Attract { at_m: Vec3::Y, gm_m3_s2: 2.0, softening_m: 0.2 };
    scene
}

/// A scene with what neither of the other two has.
pub(super) fn third() -> Scene {
    let mut scene = Scene::default();
    scene.species[0].burns = Some(Burning::default());
    scene.sources[0].recycle_after_s = None;
    scene.wind.plumes = vec![Plume { keys: Vec::new(), fed_within_m: Some(2.0), ..Plume::default() }];
    scene.species[0].rotation = RotationModel::TanabeKaneko { friction_per_s: 5.0 };
    let motion = &mut scene.species[0].motion;
    (motion.descent_m_s, motion.rose_swings) = (Some(1.0), Some(5));
    scene.species[0].tables = Some("a.tables".into());
    let shape = ObjectShape::Cylinder { radius_m: 0.2, height_m: 1.0 };
    scene.ground.litter = Some(Litter { leaf_area_index: 0.0, ..Litter::default() });
    let key = |time_s, x: f32| ObjectKey { time_s, moved_m: Vec3::X * x, turned_deg: 0.0 };
    let motion = ObjectMotion::Path(vec![key(0.0, 0.0), key(2.0, 1.0)]);
    scene.objects = vec![Object { shape, motion, ..Object::default() }];
    let hull = CrownHull::Mesh { file: "crown.glb".into(), scale: 1.0 };
    let form = TreeForm::SpaceColonization(SpaceColonization { hull, ..SpaceColonization::default() });
    scene.tree_kinds = vec![TreeKind { form, ..TreeKind::default() }];
    scene.view.lens.tone_map = ToneMap::Linear { gamma: 2.0 };
    let mut one = population("third", Air::Quadratic { drag: 0.5 }, "turn");
    one.from = ParticleShape::Ring { center_m: Vec3::Y, radius_m: 1.0, axis: Vec3::Y };
    one.direction = Direction::Outward;
    one.count = 4000;
    one.look.size = vec![(0.2, 1.0), (0.5, 2.0)];
    one.look.kind = LookKind::Blobs { radius_m: 0.3, threshold: 0.4 };
    scene.particles = vec![one];
    let of = ForceKind::Swirl {
        at_m: Vec3::ZERO,
        axis: Vec3::Y,
        rate_rad_s: 2.0,
        swirl_radius_m: 1.0,
        profile: SwirlProfile::Compact { d: 0.0 },
    };
    scene.forces = vec![Force { name: "turn".into(), of, carried_by: None }];
    scene
}

/// Leaves on cone spirals, and a kind of trees that grows into a profile.
pub(super) fn winding() -> Scene {
    let mut scene = Scene::default();
    let form = TreeForm::ParticleFlow(ParticleFlow::default());
    scene.tree_kinds = vec![TreeKind { form, ..TreeKind::default() }];
    scene.species[0].start = Primitive::ConeSpiral;
    scene.species[0].motion.cone_radius_m = Some(1.0);
    scene
}

/// Particles, others that are born of them, and some that carry a force.
pub(super) fn nested() -> Scene {
    let text = "(particles: [
        (name: \"spark\", count: 100, release: Rate(per_s: 20.0, from_s: 0.0), life_s: Some(Constant(2.0))),
        (name: \"drop\", count: 400, nest: Some((of: \"spark\", on: Every(steps: 60), fan: 2, inherit: 0.5, radius_m: 0.1)),
         life_s: Some(Constant(0.5))),
        (name: \"whirl\", count: 8, release: Burst(at_s: 0.0), life_s: None, feels: [\"pull\"]),
    ],
    forces: [(name: \"pull\", of: Attract(at_m: (0.0, 0.0, 0.0), gm_m3_s2: 1.0, softening_m: 0.1),
              carried_by: Some((of: \"whirl\", strength: [(0.2, 0.5), (0.6, 1.0)])))])";
    Scene::from_ron(text, "nested").expect("RON")
}
