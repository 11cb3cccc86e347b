// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things against geometry and the laws of contact: distances, restitution and friction, corners and closing walls, leaves that
//! lie on them and are pushed by them, and none that gets inside. One file, because all of these share a few scenes and helpers.

use glam::{DVec3, Vec2, Vec3 as Point};
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::flight::body::{LeafBody, body_of};
use windfall_core::device::flight::rates::FlightMotion;
use windfall_core::device::flight::strike::{solid_gap, strike_solids};
use windfall_core::device::leaf::record::{SIZE_ONE, STATE_DORMANT, flies, is_held, leaf_state, lies};
use windfall_core::device::solid::distance::solid_distance;
use windfall_core::device::solid::near::{may_meet_solids, near_count, near_solid, solids_cell};
use windfall_core::device::solid::shape::solid_at;
use windfall_core::scene::{
    Gusts, Litter, MeanSpeed, Object, ObjectFriction, ObjectKey, ObjectMotion, ObjectShape, Profile, Release,
    Source, SourceShape, Species, Tree, Turbulence, Walker, WindParameters,
};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Air that does not move.
pub(crate) fn calm() -> WindParameters {
    WindParameters {
        speed: MeanSpeed::MetresPerSecond(0.0),
        gusts: Gusts { strength: 0.0, ..Gusts::default() },
        turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
        ..WindParameters::default()
    }
}

/// Leaves that fall over some objects.
pub(crate) fn scene(objects: Vec<Object>, leaves: u32) -> Scene {
    let mut scene = Scene {
        species: vec![Species { size_m: 0.06, areal_density_kg_m2: 0.05, ..Species::default() }],
        wind: calm(),
        objects,
        ..Scene::default()
    };
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(10.0), ..Litter::default() });
    scene.sources = vec![Source {
        shape: SourceShape::Box {
            center_m: Point::new(0.0, 2.5, 0.0),
            half_extent_m: Point::new(1.5, 0.3, 1.5),
        },
        count: leaves,
        release: Release::Rate { per_s: 300.0, from_s: 0.0 },
        recycle_after_s: None,
        species: Vec::new(),
    }];
    scene
}

pub(crate) fn solid(shape: ObjectShape, at_m: Point) -> Object {
    Object { shape, at_m, ..Object::default() }
}

pub(crate) fn stepped(world: &World, steps: u32) -> World {
    let mut simulator = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.world().clone()
}

/// Deepest that any body, any leaf that lies, or the centre of any other leaf in the air is inside a solid part, in m.
pub(crate) fn deepest_m(world: &World) -> f32 {
    let step = world.compiled.step_block(&world.clock);
    let cx = world.context(&step);
    let mut deepest = 0f32;
    for slot in 0..world.leaves.len() {
        let place = world.leaves.place[slot];
        if leaf_state(place.bits) == STATE_DORMANT {
            continue;
        }
        // What a synthesised fall turns by is not swept.
        let reach_share = if flies(place.bits) || lies(place.bits) { 1.0 } else { 0.0 };
        let body = body_of(&cx, place.bits, world.leaves.schedule[slot].size);
        let pose = Quat::from(world.leaves.attitude[slot].quaternion);
        let at = Vec3::from(place.position);
        let cell = solids_cell(&cx, at);
        for entry in 0..near_count(&cx, cell) {
            let part = solid_at(&cx, near_solid(&cx, cell, entry), 0.0);
            deepest = deepest.max(-solid_gap(&cx, &part, &body, pose, at, reach_share).gap_m);
        }
    }
    deepest
}

#[test]
fn leaves_lie_on_tops_and_none_is_inside() {
    let top = solid(ObjectShape::Box { size_m: Point::new(1.6, 0.5, 1.6) }, Point::new(0.0, 0.25, 0.0));
    let mut world = World::build(&scene(vec![top], 1500)).expect("valid");
    for _ in 0..40 {
        world = stepped(&world, 30);
        let deepest = deepest_m(&world);
        assert!(deepest < 1.0e-3, "{deepest} m deep at {} s", world.clock.seconds());
    }
    let stats = world.litter_stats().expect("litter");
    // The box takes 0.284 of the source's area.
    let share = f64::from(stats.held) / 1500.0;
    assert!((0.2..0.36).contains(&share), "{stats:?}");
    assert_eq!(stats.held + stats.lying, 1500, "all have come to rest: {stats:?}");
    for place in world.leaves.place.iter().filter(|place| is_held(place.bits) && lies(place.bits)) {
        assert!((0.49..0.56).contains(&place.position[1]), "{place:?}");
    }
}

/// Distance from the surface of a shape about the origin, in double precision, by clamping to its core.
fn distance_m(shape: &ObjectShape, place: DVec3) -> f64 {
    let radial = DVec3::new(place.x, 0.0, place.z).length();
    let corner = |u: f64, v: f64| {
        let outside = u.max(0.0).hypot(v.max(0.0));
        if outside > 0.0 { outside } else { u.max(v) }
    };
    match *shape {
        ObjectShape::Sphere { radius_m } => place.length() - f64::from(radius_m),
        ObjectShape::Capsule { radius_m, length_m } => {
            let half = 0.5 * f64::from(length_m);
            (place - DVec3::Y * place.y.clamp(-half, half)).length() - f64::from(radius_m)
        }
        ObjectShape::Box { size_m } => {
            let beyond = place.abs() - 0.5 * size_m.as_dvec3();
            let outside = beyond.max(DVec3::ZERO).length();
            if outside > 0.0 { outside } else { beyond.max_element() }
        }
        ObjectShape::Cylinder { radius_m, height_m } => {
            corner(radial - f64::from(radius_m), place.y.abs() - 0.5 * f64::from(height_m))
        }
        ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. } => {
            unreachable!("in faces.rs")
        }
    }
}

/// Random numbers between -1 and 1 by a number.
pub(crate) fn spread(number: u32) -> [f32; 6] {
    let mut state = u64::from(number).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d;
    [(); 6].map(|()| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "24 bits")]
        let share = (state >> 40) as f32 / 8_388_608.0;
        share - 1.0
    })
}

fn point(at: [f32; 3]) -> Vec3 {
    Vec3::from(at)
}

#[test]
fn distances_and_normals_are_those_of_the_shapes() {
    let shapes = [
        ObjectShape::Sphere { radius_m: 0.4 },
        ObjectShape::Capsule { radius_m: 0.2, length_m: 0.9 },
        ObjectShape::Box { size_m: Point::new(0.5, 1.0, 0.7) },
        ObjectShape::Cylinder { radius_m: 0.45, height_m: 0.6 },
    ];
    for shape in shapes {
        let object =
            Object { heading_deg: 30.0, tilt_deg: -50.0, ..solid(shape.clone(), Point::new(0.3, 1.0, -0.2)) };
        let world = World::build(&scene(vec![object], 10)).expect("valid");
        let step = world.compiled.step_block(&world.clock);
        let cx = world.context(&step);
        let part = solid_at(&cx, 0, 0.0);
        let turn = glam::DQuat::from_rotation_y(30f64.to_radians())
            * glam::DQuat::from_rotation_x(-50f64.to_radians());
        for number in 0..20_000 {
            let [x, y, z, ..] = spread(number);
            let from_center = DVec3::new(x.into(), y.into(), z.into());
            let place = DVec3::new(0.3, 1.0, -0.2) + from_center;
            let single = place.as_vec3();
            let found = solid_distance(&cx, &part, Vec3::new(single.x, single.y, single.z));
            let inner =
                turn.inverse() * (single.as_dvec3() - DVec3::new(0.3, 1.0, -0.2).as_vec3().as_dvec3());
            let expected = distance_m(&shape, inner);
            assert!(
                (f64::from(found.distance_m) - expected).abs() < 2.0e-6,
                "{shape:?} at {inner}: {found:?}"
            );
            // Along the normal the distance grows as the way does.
            let normal = DVec3::new(found.normal.x.into(), found.normal.y.into(), found.normal.z.into());
            let farther = distance_m(&shape, inner + turn.inverse() * normal * 1.0e-4);
            let growth = (farther - expected) / 1.0e-4;
            let is_smooth = expected > 0.0 || (growth - 1.0).abs() < 0.01 || expected < -0.01;
            assert!((normal.length() - 1.0).abs() < 1.0e-5, "{shape:?} at {inner}: {normal}");
            assert!(!is_smooth || growth > 0.99 || expected < -0.01, "{shape:?} at {inner}: {growth}");
        }
    }
}

/// A leaf that lies level, as a body.
pub(crate) fn level_leaf(world: &World) -> LeafBody {
    let step = world.compiled.step_block(&world.clock);
    body_of(&world.context(&step), 0, SIZE_ONE | 0x7777_0000)
}

/// Velocity with which a level leaf leaves the top of a box that it comes down on.
fn after_contact(friction: ObjectFriction, restitution: f32, velocity: [f32; 3]) -> Vec3 {
    let top = Object {
        friction,
        restitution,
        ..solid(ObjectShape::Box { size_m: Point::new(2.0, 1.0, 2.0) }, Point::new(0.0, 0.5, 0.0))
    };
    let world = World::build(&scene(vec![top], 10)).expect("valid");
    let step = world.compiled.step_block(&world.clock);
    let cx = world.context(&step);
    let velocity = point(velocity);
    let flown = FlightMotion { velocity, pose: Quat::new(0.0, 0.0, 0.0, 1.0), turning: Vec3::ZERO };
    let from = Vec3::new(0.1, 1.005, 0.1);
    let time = 1.0 / 60.0;
    strike_solids(&cx, &level_leaf(&world), from, velocity * time, flown, 0.0, time).motion.velocity
}

#[test]
fn restitution_and_both_kinds_of_friction_are_as_their_laws_have_it() {
    for restitution in [0.0, 0.3, 0.8, 1.0] {
        let left = after_contact(ObjectFriction::Coulomb(0.0), restitution, [0.4, -2.0, 0.0]);
        assert!((left.y - 2.0 * restitution).abs() < 1.0e-5 * 2.0, "{restitution}: {left:?}");
        assert!((left.x - 0.4).abs() < 1.0e-5, "without friction: {left:?}");
    }
    // The impulse into the surface is 2.0 (1 + e); friction takes at most mu times that.
    let slides = after_contact(ObjectFriction::Coulomb(0.2), 0.5, [3.0, -2.0, 0.0]);
    assert!((slides.x - (3.0 - 0.2 * 2.0 * 1.5)).abs() < 1.0e-4, "{slides:?}");
    let stops = after_contact(ObjectFriction::Coulomb(1.0), 0.5, [0.7, -2.0, 0.3]);
    assert!(stops.x.abs() < 1.0e-5 && stops.z.abs() < 1.0e-5, "{stops:?}");
    let shared = after_contact(ObjectFriction::Loss(0.3), 0.5, [3.0, -2.0, -1.0]);
    assert!((shared.x - 0.7 * 3.0).abs() < 1.0e-4 && (shared.z + 0.7).abs() < 1.0e-4, "{shared:?}");
}

/// Kinetic energy over mass of a body in J/kg.
fn energy(body: &LeafBody, motion: &FlightMotion) -> f64 {
    let square = |v: f32| f64::from(v) * f64::from(v);
    let Vec3 { x, y, z } = motion.velocity;
    let share = f64::from(body.inv_size_ratio) * f64::from(body.inv_size_ratio);
    let inertia = [body.inv_inertia.x, body.inv_inertia.y, body.inv_inertia.z]
        .map(|inv| 1.0 / (f64::from(inv) * share));
    let spin =
        [motion.turning.x, motion.turning.y, motion.turning.z].map(|turning| turning * body.inv_size_ratio);
    let turning: f64 = inertia.iter().zip(spin).map(|(inertia, spin)| inertia * square(spin)).sum();
    0.5 * (square(x) + square(y) + square(z) + turning)
}

#[test]
fn leaves_at_sixty_metres_a_second_pass_no_thin_wall_and_gain_no_energy() {
    let wall = Object {
        heading_deg: 15.0,
        restitution: 0.5,
        ..solid(ObjectShape::Box { size_m: Point::new(6.0, 6.0, 0.02) }, Point::new(0.0, 1.0, 0.0))
    };
    let world = World::build(&scene(vec![wall], 10)).expect("valid");
    let step = world.compiled.step_block(&world.clock);
    let cx = world.context(&step);
    let body = level_leaf(&world);
    let part = solid_at(&cx, 0, 0.0);
    let normal = solid_distance(&cx, &part, Vec3::new(0.0, 1.0, 0.6)).normal;
    let side = |place: Vec3| {
        (place.x - part.center.x) * normal.x
            + (place.y - part.center.y) * normal.y
            + (place.z - part.center.z) * normal.z
    };
    let mut struck = 0;
    for number in 0..50_000 {
        let [x, y, z, u, v, w] = spread(number);
        let mut place = Vec3::new(0.5 * x, 1.0 + 0.5 * y, 0.5 + 0.3 * z);
        let pose = windfall_core::arith::quaternion::quat_normalize(Quat::new(u, v, w, 0.3));
        let mut motion = FlightMotion {
            velocity: Vec3::new(20.0 * u, 20.0 * v, -57.0),
            pose,
            turning: Vec3::new(30.0 * w, 10.0 * x, 30.0 * y),
        };
        let time = 1.0 / 60.0;
        for _ in 0..4 {
            let before = energy(&body, &motion);
            let contact = strike_solids(&cx, &body, place, motion.velocity * time, motion, 0.0, time);
            struck += u32::from(contact.touches);
            assert!(side(contact.position) > 0.0, "case {number} is behind the wall: {contact:?}");
            let after = energy(&body, &contact.motion);
            assert!(after <= before * (1.0 + 1.0e-4), "case {number}: {after} J/kg of {before}");
            (place, motion) = (contact.position, contact.motion);
        }
    }
    assert!(struck > 40_000, "{struck} contacts");
}

/// Objects that leave a wedge of an angle in degrees between them, open upwards.
fn wedge(angle_deg: f32) -> Vec<Object> {
    [-1.0f32, 1.0]
        .map(|side| {
            // Turned about x by half the angle, a wall's inner face passes through the height of 1 m above the origin.
            let lean = (0.5 * angle_deg).to_radians();
            let (up, out) = (lean.cos(), lean.sin());
            let center = Point::new(0.0, 1.0 + 2.0 * up - out, side * (2.0 * out + up));
            Object {
                tilt_deg: side * 0.5 * angle_deg,
                friction: ObjectFriction::Coulomb(0.0),
                restitution: 0.3,
                ..solid(ObjectShape::Box { size_m: Point::new(4.0, 4.0, 2.0) }, center)
            }
        })
        .to_vec()
}

#[test]
fn particles_in_wedges_stay_outside() {
    for angle_deg in [10.0, 30.0, 90.0] {
        let world = World::build(&scene(wedge(angle_deg), 10)).expect("valid");
        let step = world.compiled.step_block(&world.clock);
        let cx = world.context(&step);
        // As small as sizes allow: a body of 3 mm.
        let mut body = level_leaf(&world);
        body.size_ratio = 0.05;
        body.inv_size_ratio = 20.0;
        let pose = Quat::new(0.0, 0.0, 0.0, 1.0);
        let inside = |place: Vec3| {
            (0..2)
                .map(|number| -solid_gap(&cx, &solid_at(&cx, number, 0.0), &body, pose, place, 1.0).gap_m)
                .fold(f32::MIN, f32::max)
        };
        let (mut struck, mut cases) = (0, 0);
        for number in 0..40_000 {
            let [x, y, z, u, v, w] = spread(number);
            let mut place = Vec3::new(x, 2.0 + 0.9 * y, 0.5 * z * (1.0 + y));
            if inside(place) > -1.0e-4 {
                continue;
            }
            cases += 1;
            let mut motion = FlightMotion {
                velocity: Vec3::new(8.0 * u, -20.0 + 15.0 * v, 12.0 * w),
                pose,
                turning: Vec3::ZERO,
            };
            for step in 0..6 {
                let time = 1.0 / 60.0;
                let contact = strike_solids(&cx, &body, place, motion.velocity * time, motion, 0.0, time);
                struck += u32::from(contact.touches);
                let deep = inside(contact.position);
                assert!(deep < 1.0e-3, "{angle_deg} degrees, case {number}, step {step}: {deep} m inside");
                (place, motion) = (contact.position, contact.motion);
            }
        }
        assert!(cases > 3_000 && struck > 2 * cases, "{angle_deg} degrees: {cases} cases, {struck} contacts");
    }
}

/// A roller that crosses a bed takes the leaves out of its way, and a walker leaves a furrow.
#[test]
fn what_moves_pushes_what_lies_in_its_way() {
    let plow = Object {
        motion: ObjectMotion::Path(vec![
            ObjectKey { time_s: 1.0, moved_m: Point::ZERO, turned_deg: 0.0 },
            ObjectKey { time_s: 5.0, moved_m: Point::new(6.0, 0.0, 0.0), turned_deg: 0.0 },
        ]),
        ..solid(ObjectShape::Box { size_m: Point::new(0.4, 0.6, 1.0) }, Point::new(-3.0, 0.25, 0.0))
    };
    let mut scene = scene(vec![plow], 10);
    scene.ground.litter =
        Some(Litter { size_m: Vec2::splat(8.0), leaf_area_index: 1.0, ..Litter::default() });
    let world = World::build(&scene).expect("valid");
    let end = stepped(&world, 400);
    let in_strip = |world: &World| {
        let inside = |p: &[f32; 3]| p[0].abs() < 2.0 && p[2].abs() < 0.35;
        world.leaves.place.iter().filter(|place| lies(place.bits) && inside(&place.position)).count()
    };
    let (before, after) = (in_strip(&world), in_strip(&end));
    assert!(before > 500 && after * 10 < before, "{after} of {before} leaves are still in its way");
    let step = end.compiled.step_block(&end.clock);
    let far = Vec3::new(-3.9, 0.0, -3.9);
    assert!(!may_meet_solids(&end.context(&step), far, 1.0), "nothing is near the corner");

    let mut walked = scene.clone();
    walked.objects.clear();
    walked.walkers =
        vec![Walker { way_m: vec![Vec2::new(-3.5, 0.0), Vec2::new(3.5, 0.0)], ..Walker::default() }];
    let end = stepped(&World::build(&walked).expect("valid"), 400);
    let moved = |world: &World, start: &World| {
        let pairs = world.leaves.place.iter().zip(&start.leaves.place);
        pairs.filter(|(now, then)| now.position != then.position).count()
    };
    let start = World::build(&walked).expect("valid");
    assert!(moved(&end, &start) > 100, "{} leaves have been kicked", moved(&end, &start));
}

#[test]
fn trunks_are_in_the_way_of_leaves() {
    let mut scene = scene(Vec::new(), 2000);
    scene.trees = vec![Tree { kind: "oak".into(), height_m: Some(9.0), leaves: 0, ..Tree::default() }];
    scene.wind.speed = MeanSpeed::MetresPerSecond(4.0);
    scene.wind.direction_deg = 0.0;
    scene.wind.profile = Profile::Uniform;
    scene.sources[0].shape =
        SourceShape::Box { center_m: Point::new(-2.5, 2.5, 0.0), half_extent_m: Point::new(0.2, 0.5, 0.6) };
    let mut world = World::build(&scene).expect("valid");
    let trunks = world.compiled.block().solids.count;
    assert!((5..200).contains(&trunks), "{trunks} solid pieces of an oak");
    let mut bodies = 0;
    for _ in 0..20 {
        world = stepped(&world, 15);
        let deepest = deepest_m(&world);
        assert!(deepest < 1.0e-3, "{deepest} m deep at {} s", world.clock.seconds());
        bodies = bodies.max(world.leaves.place.iter().filter(|place| flies(place.bits)).count());
    }
    assert!(bodies > 20, "{bodies} leaves fly on as bodies at once");
}

#[test]
fn boards_hold_leaves_up_to_the_angle_of_friction() {
    const FRICTION: f32 = 0.8;
    let held = [5.0f32, 15.0, 30.0, 35.0, 42.0, 45.0].map(|tilt_deg| {
        let board = Object {
            tilt_deg,
            friction: ObjectFriction::Coulomb(FRICTION),
            ..solid(ObjectShape::Box { size_m: Point::new(2.4, 0.06, 2.4) }, Point::new(0.0, 1.2, 0.0))
        };
        let mut scene = scene(vec![board], 300);
        scene.sources[0].shape = SourceShape::Disc { center_m: Point::new(0.0, 2.3, 0.0), radius_m: 0.4 };
        let end = stepped(&World::build(&scene).expect("valid"), 60 * 8);
        end.leaves.place.iter().filter(|place| lies(place.bits) && is_held(place.bits)).count()
    });
    println!("{held:?} of 300 held on boards of 5, 15, 30, 35, 42 and 45°");
    assert!(held[0] > 200 && held[1] > 200, "{held:?} on gentle slopes");
    assert!(held[2] > 200 && held[3] > 200, "{held:?}: atan 0.8 is 38.7°");
    assert_eq!(held[4..], [0, 0], "{held:?}: nothing stays beyond it");
}
