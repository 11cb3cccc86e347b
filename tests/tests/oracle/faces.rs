// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polyhedra and meshes: distances against geometry, and leaves that strike them, lie on them and fall through their holes.

use glam::{DVec3, Vec3 as Point};
use windfall_core::arith::quaternion::quat_normalize;
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::flight::rates::FlightMotion;
use windfall_core::device::flight::strike::{solid_gap, strike_solids};
use windfall_core::device::leaf::record::{is_held, lies};
use windfall_core::device::solid::distance::solid_distance;
use windfall_core::device::solid::shape::{SolidAt, solid_at};
use windfall_core::scene::{Object, ObjectFriction, ObjectShape};
use windfall_core::{Context, World};
use windfall_tests::strategies::torus;

use super::solids::{deepest_m, level_leaf, scene, solid, spread, stepped};

/// A polyhedron with the corners of a box.
fn block(size_m: Point) -> ObjectShape {
    let sign = |corner: u8, bit: u8| if corner & bit == 0 { -0.5 } else { 0.5 };
    let corners_m = (0..8).map(|at| size_m * Point::new(sign(at, 1), sign(at, 2), sign(at, 4)));
    ObjectShape::Polyhedron { corners_m: corners_m.collect() }
}

/// Distance of a place in m from a torus about y with radii of 0.5 m and 0.15 m.
fn torus_m(place: DVec3) -> f64 {
    (place.x.hypot(place.z) - 0.5).hypot(place.y) - 0.15
}

/// Does something with what a world of one object is at its start.
fn with_context<T>(object: Object, examine: impl FnOnce(&World, &Context<'_>) -> T) -> T {
    let world = World::build(&scene(vec![object], 10)).expect("valid");
    let step = world.compiled.step_block(&world.clock);
    examine(&world, &world.context(&step))
}

#[test]
fn polyhedra_have_the_distances_of_their_faces() {
    let half = DVec3::new(0.25, 0.5, 0.35);
    let object = solid(block(2.0 * half.as_vec3()), Point::new(0.0, 1.0, 0.0));
    with_context(object, |_, cx| {
        let part = solid_at(cx, 0, 0.0);
        for number in 0..20_000 {
            let [x, y, z, ..] = spread(number);
            let found = solid_distance(cx, &part, Vec3::new(x, 1.0 + y, z));
            let beyond = DVec3::new(x.into(), y.into(), z.into()).abs() - half;
            let from_face = beyond.max_element();
            assert!((f64::from(found.distance_m) - from_face).abs() < 2e-6, "{found:?} at {x}, {y}, {z}");
            let along = [found.normal.x * x, found.normal.y * y, found.normal.z * z];
            let axis = (0..3).fold(0, |most, axis| if beyond[axis] > beyond[most] { axis } else { most });
            assert!((along[axis] - [x, y, z][axis].abs()).abs() < 1e-5, "{found:?} at {x}, {y}, {z}");
        }
    });
}

/// A plane, tilted and turned: its distance is that from the plane, and what strikes it leaves by the law.
#[test]
fn planes_are_half_spaces() {
    let plane =
        Object { tilt_deg: 25.0, heading_deg: 40.0, restitution: 0.5, ..solid(ObjectShape::Plane, Point::Y) };
    let up = glam::Quat::from_rotation_y(40f32.to_radians())
        * glam::Quat::from_rotation_x(25f32.to_radians())
        * Point::Y;
    with_context(plane, |world, cx| {
        let part = solid_at(cx, 0, 0.0);
        for number in 0..2_000 {
            let [x, y, z, ..] = spread(number);
            let at = 30.0 * Point::new(x, y, z);
            let found = solid_distance(cx, &part, Vec3::new(at.x, at.y, at.z));
            let expected_m = (at - Point::Y).dot(up);
            assert!((found.distance_m - expected_m).abs() < 1e-4, "{found:?}, not {expected_m} m, at {at}");
        }
        let mut body = level_leaf(world);
        (body.size_ratio, body.inv_size_ratio) = (0.05, 20.0);
        for number in 0..2_000 {
            let [x, z, u, v, w, _] = spread(number);
            let across = Point::new(20.0 * x, 0.0, 20.0 * z);
            let from = Point::Y + across - across.dot(up) * up + 0.3 * up;
            let velocity = 20.0 * (Point::new(u, v, w) - up);
            let motion = FlightMotion {
                velocity: Vec3::new(velocity.x, velocity.y, velocity.z),
                pose: Quat::new(0.0, 0.0, 0.0, 1.0),
                turning: Vec3::ZERO,
            };
            let time = 1.0 / 30.0;
            let contact = strike_solids(
                cx,
                &body,
                Vec3::new(from.x, from.y, from.z),
                motion.velocity * time,
                motion,
                0.0,
                time,
            );
            let end = Point::from(contact.position.to_array());
            let above_m = (end - Point::Y).dot(up);
            assert!(above_m > -1e-3, "case {number}: {above_m} m above the plane");
            let is_swift = velocity.dot(up) * time < -0.35;
            assert!(contact.touches || !is_swift, "case {number} passes from {from} by {}", velocity * time);
        }
    });
}

/// Asserts that normals of a mesh are the slopes of its distance between the nodes of its grid. Within a cell it is linear along each
/// axis, so that differences have no error but rounding; places whose neighbours lie in another cell bend, and are left out.
fn normals_are_slopes(cx: &Context<'_>, part: &SolidAt) {
    const STEP_M: f32 = 5e-4;
    let mut seen = 0;
    for number in 0..20_000 {
        let [x, y, z, ..] = spread(number);
        let at = Vec3::new(0.6 * x, 1.0 + 0.15 * y, 0.6 * z);
        let found = solid_distance(cx, part, at);
        let beside_m = |step: Vec3| f64::from(solid_distance(cx, part, at + step).distance_m);
        let mut slope = DVec3::ZERO;
        let mut is_straight = true;
        for axis in 0..3 {
            let mut step = [0.0; 3];
            step[axis] = STEP_M;
            let (before_m, after_m) = (beside_m(Vec3::from(step) * -1.0), beside_m(Vec3::from(step)));
            slope[axis] = after_m - before_m;
            is_straight &= (after_m - 2.0 * f64::from(found.distance_m) + before_m).abs() < 1e-7;
        }
        if is_straight && slope.length() > 1e-4 {
            seen += 1;
            let normal = DVec3::new(found.normal.x.into(), found.normal.y.into(), found.normal.z.into());
            let off = normal.distance(slope.normalize());
            assert!(off < 2e-3, "{found:?} at {at:?}: off by {off} from the slope {slope}");
        }
    }
    assert!(seen > 10_000, "only {seen} places lie with their neighbours in one cell");
}

#[test]
fn meshes_have_the_distances_of_their_surfaces() {
    let object = solid(torus(1.0), Point::new(0.0, 1.0, 0.0));
    with_context(object, |_, cx| {
        let part = solid_at(cx, 0, 0.0);
        let (mut near, mut worst_m) = (0, 0f64);
        for number in 0..40_000 {
            let [x, y, z, ..] = spread(number);
            let at = DVec3::new(x.into(), (0.6 * y).into(), z.into());
            let found = solid_distance(cx, &part, Vec3::new(x, 1.0 + 0.6 * y, z));
            let expected_m = torus_m(at);
            // Sides of the 24 by 12 lie up to 6 and 5 mm within the torus; a cell is 24 mm.
            let off_m = f64::from(found.distance_m) - expected_m;
            if expected_m.abs() < 0.1 {
                near += 1;
                worst_m = worst_m.max(off_m.abs());
                assert!((-0.003..0.0125).contains(&off_m), "{found:?}, not {expected_m} m, at {at}");
                let normal = DVec3::new(found.normal.x.into(), found.normal.y.into(), found.normal.z.into());
                let growth = (torus_m(at + 1e-3 * normal) - expected_m) / 1e-3;
                // Sides are turned from the torus by up to 15 degrees.
                assert!(growth > 0.9 || expected_m < -0.1, "{found:?} at {at}: {growth}");
            }
            // Nowhere is there less room than it says, but deep within, where cells round off the ridge.
            assert!(off_m < 0.0125 || expected_m < -0.1, "{found:?}, not {expected_m} m, at {at}");
        }
        println!("{near} places near the surface, off by {worst_m} m at most");
        normals_are_slopes(cx, &part);
        assert!(near > 4_000, "{near} places near the surface");
    });
}

#[test]
fn leaves_leave_polyhedra_and_meshes_by_restitution() {
    let shapes = [block(Point::new(2.0, 1.0, 2.0)), block_mesh()];
    for shape in shapes {
        for restitution in [0.0, 0.3, 1.0] {
            let friction = ObjectFriction::Coulomb(0.0);
            let object = Object { friction, restitution, ..solid(shape.clone(), Point::new(0.0, 0.5, 0.0)) };
            with_context(object, |world, cx| {
                let velocity = Vec3::new(0.4, -2.0, 0.0);
                let flown =
                    FlightMotion { velocity, pose: Quat::new(0.0, 0.0, 0.0, 1.0), turning: Vec3::ZERO };
                let time = 1.0 / 60.0;
                let from = Vec3::new(0.1, 1.005, 0.1);
                let contact = strike_solids(cx, &level_leaf(world), from, velocity * time, flown, 0.0, time);
                let left = contact.motion.velocity;
                assert!(contact.touches, "{shape:?}");
                assert!((left.y - 2.0 * restitution).abs() < 2e-5, "{shape:?}, {restitution}: {left:?}");
                assert!((left.x - 0.4).abs() < 1e-5, "{shape:?} without friction: {left:?}");
            });
        }
    }
}

/// A mesh of a box of 2 m by 1 m by 2 m.
fn block_mesh() -> ObjectShape {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/data/block.gltf");
    ObjectShape::Mesh { file: file.into(), scale: 1.0 }
}

/// True if a way of a point passes at least so deep through the torus.
fn passes(from: DVec3, way: DVec3, depth_m: f64) -> bool {
    (0..=400).any(|step| torus_m(from + way * (f64::from(step) / 400.0)) < -depth_m)
}

#[test]
fn bodies_at_sixty_metres_a_second_pass_no_mesh_but_its_hole() {
    let center = Point::new(0.0, 1.0, 0.0);
    let object = Object { restitution: 0.4, ..solid(torus(1.0), center) };
    with_context(object, |world, cx| {
        // As small as sizes allow: a body of 3 mm.
        let mut body = level_leaf(world);
        (body.size_ratio, body.inv_size_ratio) = (0.05, 20.0);
        let part = solid_at(cx, 0, 0.0);
        let time = 1.0 / 60.0;
        let (mut struck, mut through) = (0, 0);
        for number in 0..40_000 {
            let [x, y, z, u, v, w] = spread(number);
            let pose = quat_normalize(Quat::new(u, v, w, 0.3));
            let velocity = Vec3::new(15.0 * u, -55.0 + 5.0 * v, 15.0 * w);
            let mut motion = FlightMotion { velocity, pose, turning: Vec3::ZERO };
            let mut place = Vec3::new(0.8 * x, 1.5 + 0.2 * y, 0.8 * z);
            let local = |place: Vec3| DVec3::new(place.x.into(), f64::from(place.y) - 1.0, place.z.into());
            for _ in 0..3 {
                let way = motion.velocity * time;
                let contact = strike_solids(cx, &body, place, way, motion, 0.0, time);
                let straight = local(place + way) - local(place);
                if passes(local(place), straight, 0.015) {
                    struck += u32::from(contact.touches);
                    // A way along the surface may end before it strikes; the rest of it is lost.
                    let flown = local(contact.position) - local(place);
                    assert!(
                        contact.touches || !passes(local(place), flown, 0.015),
                        "case {number} passes from {place:?} by {way:?}"
                    );
                } else if !contact.touches
                    && torus_m(local(contact.position)) < 0.35
                    && contact.position.y < 1.0
                {
                    through += 1;
                }
                let gap = solid_gap(cx, &part, &body, pose, contact.position, 1.0);
                assert!(gap.gap_m > -1.0e-3, "case {number} is {} m inside", -gap.gap_m);
                (place, motion) = (contact.position, contact.motion);
            }
        }
        println!("{struck} strikes, {through} flights past");
        assert!(struck > 10_000 && through > 1_000, "{struck} strikes, {through} flights past");
    });
}

#[test]
fn leaves_lie_on_meshes_and_fall_through_their_holes() {
    let rough = ObjectFriction::Coulomb(0.9);
    let ring = Object { friction: rough, ..solid(torus(2.0), Point::new(0.0, 1.2, 0.0)) };
    let mut world = World::build(&scene(vec![ring], 1500)).expect("valid");
    for _ in 0..25 {
        world = stepped(&world, 30);
        let deepest = deepest_m(&world);
        assert!(deepest < 2.0e-3, "{deepest} m deep at {} s", world.clock.seconds());
    }
    let resting = || world.leaves.place.iter().filter(|place| lies(place.bits));
    let held = resting().filter(|place| is_held(place.bits)).count();
    let within =
        resting().filter(|place| place.position[0].hypot(place.position[2]) < 0.6 && !is_held(place.bits));
    let within = within.count();
    println!("{held} lie on the ring, {within} in its hole");
    // The upward part of the ring is 2 pi of 1 m by 0.45 m of 9 m² that leaves come from.
    assert!(held > 150, "{held} lie on the ring");
    assert!(within > 50, "{within} have fallen through its hole");
    for place in resting().filter(|place| is_held(place.bits)) {
        let [x, y, z] = place.position;
        let away_m = 2.0 * torus_m(DVec3::new(x.into(), f64::from(y) - 1.2, z.into()) / 2.0);
        assert!((-0.03..0.04).contains(&away_m), "{away_m} m from the ring: {place:?}");
    }
}
