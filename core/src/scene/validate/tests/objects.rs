// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things and those who walk, just right and just wrong.

use glam::{Vec2, Vec3};

use super::{failing_field, full};
use crate::scene::{
    Litter, MAX_MOVERS, MAX_OBJECTS, MAX_PATH_KEYS, Object, ObjectFriction, ObjectKey, ObjectMotion,
    ObjectShape, Scene, WALKER_LIMBS, Walker,
};

/// Change of a valid scene with an object on a path and a walker, and the field that must be named then.
type Case = (fn(&mut Scene), Option<&'static str>);
/// Path, smallest and largest allowed value, assignment.
type Row = (&'static str, f32, f32, fn(&mut Scene, f32));

const CORNERS_M: [Vec3; 4] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];

fn scene() -> Scene {
    let motion = ObjectMotion::Path(vec![key(1.0), key(6.0)]);
    let mut scene = full();
    scene.ground.litter = Some(Litter::default());
    scene.objects = vec![Object { motion, ..Object::default() }];
    scene.walkers = vec![Walker::default()];
    scene
}

fn key(time_s: f32) -> ObjectKey {
    ObjectKey { time_s, moved_m: Vec3::X, turned_deg: 0.0 }
}

fn first_key(scene: &mut Scene) -> &mut ObjectKey {
    scene.objects[0].motion = ObjectMotion::Path(vec![key(1.0)]);
    match &mut scene.objects[0].motion {
        ObjectMotion::Path(keys) => &mut keys[0],
        ObjectMotion::Still => panic!("it moves"),
    }
}

fn keys(scene: &mut Scene, times_s: &[f32]) {
    scene.objects[0].motion = ObjectMotion::Path(times_s.iter().copied().map(key).collect());
}

fn polyhedron(scene: &mut Scene, corners_m: &[Vec3]) {
    scene.objects[0].shape = ObjectShape::Polyhedron { corners_m: corners_m.to_vec() };
}

/// Corners of a prism of so many sides.
fn prism(sides: u16) -> Vec<Vec3> {
    let around =
        (0..sides).map(|side| Vec2::from_angle(f32::from(side) * std::f32::consts::TAU / f32::from(sides)));
    around.flat_map(|at| [Vec3::new(at.x, 0.0, at.y), Vec3::new(at.x, 1.0, at.y)]).collect()
}

#[rustfmt::skip]
const REALS: &[Row] = &[
    ("objects[0].shape.radius_m", 0.005, 50.0, |s, v| s.objects[0].shape = ObjectShape::Sphere { radius_m: v }),
    ("objects[0].shape.radius_m", 0.005, 50.0,
        |s, v| s.objects[0].shape = ObjectShape::Capsule { radius_m: v, length_m: 1.0 }),
    ("objects[0].shape.length_m", 0.0, 200.0,
        |s, v| s.objects[0].shape = ObjectShape::Capsule { radius_m: 0.1, length_m: v }),
    ("objects[0].shape.size_m.x", 0.02, 200.0,
        |s, v| s.objects[0].shape = ObjectShape::Box { size_m: Vec3::new(v, 1.0, 1.0) }),
    ("objects[0].shape.size_m.y", 0.02, 200.0,
        |s, v| s.objects[0].shape = ObjectShape::Box { size_m: Vec3::new(1.0, v, 1.0) }),
    ("objects[0].shape.size_m.z", 0.02, 200.0,
        |s, v| s.objects[0].shape = ObjectShape::Box { size_m: Vec3::new(1.0, 1.0, v) }),
    ("objects[0].shape.radius_m", 0.005, 50.0,
        |s, v| s.objects[0].shape = ObjectShape::Cylinder { radius_m: v, height_m: 1.0 }),
    ("objects[0].shape.height_m", 0.02, 200.0,
        |s, v| s.objects[0].shape = ObjectShape::Cylinder { radius_m: 1.0, height_m: v }),
    ("objects[0].shape.corners_m[1].x", -100.0, 100.0,
        |s, v| polyhedron(s, &[Vec3::ZERO, Vec3::X * v, Vec3::Y, Vec3::Z])),
    ("objects[0].shape.scale", 0.001, 1000.0,
        |s, v| s.objects[0].shape = ObjectShape::Mesh { file: "stone.glb".into(), scale: v }),
    ("objects[0].at_m.x", -4096.0, 4096.0, |s, v| s.objects[0].at_m.x = v),
    ("objects[0].at_m.y", -4096.0, 4096.0, |s, v| s.objects[0].at_m.y = v),
    ("objects[0].at_m.z", -4096.0, 4096.0, |s, v| s.objects[0].at_m.z = v),
    ("objects[0].heading_deg", -360.0, 360.0, |s, v| s.objects[0].heading_deg = v),
    ("objects[0].tilt_deg", -180.0, 180.0, |s, v| s.objects[0].tilt_deg = v),
    ("objects[0].restitution", 0.0, 1.0, |s, v| s.objects[0].restitution = v),
    ("objects[0].open", 0.0, 0.9, |s, v| s.objects[0].open = v),
    ("objects[0].friction.Coulomb", 0.0, 5.0, |s, v| s.objects[0].friction = ObjectFriction::Coulomb(v)),
    ("objects[0].friction.Loss", 0.0, 1.0, |s, v| s.objects[0].friction = ObjectFriction::Loss(v)),
    ("objects[0].color.x", 0.0, 1.0, |s, v| s.objects[0].color.x = v),
    ("objects[0].color.y", 0.0, 1.0, |s, v| s.objects[0].color.y = v),
    ("objects[0].color.z", 0.0, 1.0, |s, v| s.objects[0].color.z = v),
    ("objects[0].motion[0].time_s", 0.0, 86_400.0, |s, v| first_key(s).time_s = v),
    ("objects[0].motion[0].turned_deg", -360.0, 360.0, |s, v| first_key(s).turned_deg = v),
    ("objects[0].motion[0].moved_m.x", -4096.0, 4096.0, |s, v| first_key(s).moved_m.x = v),
    ("objects[0].motion[0].moved_m.y", -4096.0, 4096.0, |s, v| first_key(s).moved_m.y = v),
    ("objects[0].motion[0].moved_m.z", -4096.0, 4096.0, |s, v| first_key(s).moved_m.z = v),
    ("walkers[0].speed_m_s", 0.2, 3.0, |s, v| s.walkers[0].speed_m_s = v),
    ("walkers[0].start_s", 0.0, 86_400.0, |s, v| s.walkers[0].start_s = v),
    ("walkers[0].color.x", 0.0, 1.0, |s, v| s.walkers[0].color.x = v),
    ("walkers[0].color.y", 0.0, 1.0, |s, v| s.walkers[0].color.y = v),
    ("walkers[0].color.z", 0.0, 1.0, |s, v| s.walkers[0].color.z = v),
    ("walkers[0].way_m[0].x", -4096.0, 4096.0, |s, v| s.walkers[0].way_m[0].x = v),
    ("walkers[0].way_m[1].z", -4096.0, 4096.0, |s, v| s.walkers[0].way_m[1].y = v),
];

#[rustfmt::skip]
const CASES: &[Case] = &[
    (|_| {}, None),
    (|s| s.ground.litter = None, Some("objects")),
    (|s| { s.ground.litter = None; s.objects.clear(); }, Some("walkers")),
    (|s| s.objects = vec![Object::default(); MAX_OBJECTS], None),
    (|s| s.objects = vec![Object::default(); MAX_OBJECTS + 1], Some("objects")),
    (|s| s.objects = vec![s.objects[0].clone(); MAX_MOVERS - WALKER_LIMBS], None),
    (|s| s.objects = vec![s.objects[0].clone(); MAX_MOVERS - WALKER_LIMBS + 1], Some("objects")),
    (|s| s.walkers = vec![Walker::default(); MAX_MOVERS / WALKER_LIMBS], None),
    (|s| s.walkers = vec![Walker::default(); MAX_MOVERS / WALKER_LIMBS + 1], Some("walkers")),
    (|s| keys(s, &[]), Some("objects[0].motion")),
    (|s| keys(s, &[3.0, 3.0]), Some("objects[0].motion[1].time_s")),
    (|s| keys(s, &[3.0, 5.0, 4.0]), Some("objects[0].motion[2].time_s")),
    (|s| keys(s, &std::array::from_fn::<f32, MAX_PATH_KEYS, _>(|at| at as f32)), None),
    (|s| keys(s, &std::array::from_fn::<f32, { MAX_PATH_KEYS + 1 }, _>(|at| at as f32)), Some("objects[0].motion")),
    (|s| polyhedron(s, &CORNERS_M), None),
    (|s| polyhedron(s, &CORNERS_M[..3]), Some("objects[0].shape.corners_m")),
    (|s| polyhedron(s, &prism(16)), None),
    (|s| polyhedron(s, &prism(17)), Some("objects[0].shape.corners_m")),
    // A hole, all in a plane that no axis is normal to, and one that is thinner than what leaves may not pass.
    (|s| polyhedron(s, &[CORNERS_M.as_slice(), &[Vec3::splat(0.2)]].concat()), Some("objects[0].shape.corners_m")),
    // A corner twice is one.
    (|s| polyhedron(s, &[CORNERS_M.as_slice(), &[Vec3::X]].concat()), None),
    (|s| polyhedron(s, &[Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::Y, Vec3::ONE]), Some("objects[0].shape.corners_m")),
    (|s| polyhedron(s, &[Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y * 0.02]), None),
    (|s| polyhedron(s, &[Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y * 0.019]), Some("objects[0].shape.corners_m")),
    (|s| s.objects[0].shape = ObjectShape::Mesh { file: String::new(), scale: 1.0 }, Some("objects[0].shape.file")),
    (|s| s.walkers[0].way_m.truncate(1), Some("walkers[0].way_m")),
    (|s| s.walkers[0].way_m[1] = s.walkers[0].way_m[0] + Vec2::new(0.05, 0.0), Some("walkers[0].way_m")),
];

#[test]
fn ranges_end_where_they_should() {
    for &(path, low, high, set) in REALS {
        let field_with = |value| {
            let mut scene = scene();
            set(&mut scene, value);
            failing_field(&scene)
        };
        for inside in [low, low.next_up(), high.next_down(), high] {
            assert_eq!(field_with(inside), None, "{path}: {inside:?} is allowed");
        }
        for outside in [low.next_down(), high.next_up(), f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(field_with(outside).as_deref(), Some(path), "{path}: {outside:?} is not allowed");
        }
    }
}

#[test]
fn values_that_depend_on_each_other() {
    for (number, (change, field)) in CASES.iter().enumerate() {
        let mut scene = scene();
        change(&mut scene);
        assert_eq!(failing_field(&scene).as_deref(), *field, "case {number}");
    }
}
