// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid parts that a particle may meet on its way: none that it strikes is passed over, and few others are looked for.
#![expect(clippy::cast_possible_truncation, reason = "shares fit single precision")]

use glam::Vec3 as Point;
use windfall_core::arith::Vec3;
use windfall_core::arith::vector::vec3_dot;
use windfall_core::blocks::NEVER;
use windfall_core::device::flight::strike::Passage;
use windfall_core::device::leaf::fly::longest_way_squared;
use windfall_core::device::leaf::record::{STATE_FALLING, flies, leaf_state};
use windfall_core::device::particle::step::is_in_reach_of_solids;
use windfall_core::device::particle::strike::{STRIKE_GROUND, particle_strike};
use windfall_core::device::solid::distance::solid_distance;
use windfall_core::device::solid::near::{CLEAR_OF_SOLIDS_M, OCCUPIED_WITHIN_M, is_occupied};
use windfall_core::device::solid::shape::solid_at;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{Aerodynamics, FlightModel, Object, ObjectMotion, ObjectShape};
use windfall_core::{Scene, World};
use windfall_tests::strategies::obstructed_scene;

use crate::solids::{scene, solid, stepped};

/// Number of a sequence that fills -0.5 to 0.5 evenly.
fn centred_share(number: u32, part: f64) -> f32 {
    ((f64::from(number) * part).fract() - 0.5) as f32
}

/// Place of a sequence that fills the box around the objects evenly.
fn place_among(number: u32) -> Vec3 {
    let share = |part| centred_share(number, part);
    Vec3::new(7.0 * share(0.618_033_988_7), 0.9 + 1.7 * share(0.754_877_666_2), 7.0 * share(0.569_840_290_9))
}

/// Whatever a way strikes is foreseen by the test that decides if contacts are looked for; of ways that only pass by boxes, cylinders, balls and
/// capsules, few are taken for such.
#[test]
fn what_a_way_strikes_is_foreseen() {
    let (struck, _) = struck_and_foreseen(|_| true);
    assert!(struck > 5000, "{struck} strike");
    // Polyhedra and meshes are met as spheres around them.
    let has_faces =
        |shape: &ObjectShape| matches!(shape, ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. });
    let (struck, foreseen) = struck_and_foreseen(|shape| !has_faces(shape));
    assert!(struck > 5000 && foreseen < struck + struck / 5, "{struck} strike, {foreseen} might");
}

/// Every place so near to a part lies in an occupied cell of the occupancy grid; places that are farther away by more than a cell do not.
#[test]
fn occupied_cells_are_those_near_parts() {
    let world =
        still_objects(|shape| !matches!(shape, ObjectShape::Mesh { .. } | ObjectShape::Polyhedron { .. }));
    let step = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&step);
    // Two half diagonals of a cell, and what rounding may do.
    let beyond_m = OCCUPIED_WITHIN_M + 3f32.sqrt() / cx.scene.solids.occupancy_cells_per_m + 0.02;
    let (mut near, mut far) = (0, 0);
    for place in (0..200_000).map(place_among) {
        let distance_m = |part: u32| solid_distance(&cx, &solid_at(&cx, part, 0.0), place).distance_m;
        let nearest_m = (0..cx.scene.solids.count).map(distance_m).fold(f32::MAX, f32::min);
        if nearest_m <= OCCUPIED_WITHIN_M {
            assert!(is_occupied(&cx, place), "{place:?} is {nearest_m} m away");
            near += 1;
        } else if nearest_m > beyond_m {
            assert!(!is_occupied(&cx, place), "{place:?} is {nearest_m} m away");
            far += 1;
        }
    }
    assert!(near > 20_000 && far > 50_000, "{near} near, {far} far");
}

/// Below a plane every place is occupied, however deep.
#[test]
fn a_plane_has_no_end_below() {
    let tilted = Object { tilt_deg: 20.0, ..solid(ObjectShape::Plane, Point::new(0.0, 4.0, 0.0)) };
    for plane in [tilted.clone(), Object { tilt_deg: 0.0, ..tilted }] {
        let world = World::build(&scene(vec![plane], 1)).expect("valid");
        let step = world.compiled.step_block(&world.clock);
        let cx = world.compiled.context(&step);
        let mut below = 0;
        for place in (0..10_000).map(place_among) {
            if solid_distance(&cx, &solid_at(&cx, 0, 0.0), place).distance_m < 0.0 {
                assert!(is_occupied(&cx, place), "{place:?}");
                below += 1;
            }
        }
        assert!(below > 5000, "{below} below");
        assert!(!is_occupied(&cx, Vec3::new(0.0, 20.0, 0.0)));
    }
}

/// The objects of such shapes, all of them still.
fn still_objects(stands: impl Fn(&ObjectShape) -> bool) -> World {
    let mut scene = obstructed_scene(6, 30, 0.0, 1.0 / 60.0);
    scene.walkers.clear();
    scene.objects.iter_mut().for_each(|object| object.motion = ObjectMotion::Still);
    scene.objects.retain(|object| stands(&object.shape));
    World::build(&scene).expect("valid without what moves")
}

/// No body goes farther in a step than the way by which it is decided if it may meet solid parts, in a storm with gusts and eddies, let go
/// at rest in it.
#[test]
fn bodies_go_no_farther_than_their_longest_way() {
    let mut scene = Scene::preset("storm").expect("a preset");
    for species in &mut scene.species {
        species.flight = FlightModel::Aerodynamic(Aerodynamics::default());
    }
    let mut world = World::build(&scene).expect("valid");
    let (mut longest, mut bodies) = (0.0f32, 0);
    for _ in 0..120 {
        let next = stepped(&world, 1);
        let step = world.compiled.step_block(&world.clock);
        let cx = world.context(&step);
        for (slot, place) in world.leaves.place.iter().enumerate() {
            let there = &next.leaves.place[slot];
            let is_same = world.leaves.identity[slot].id == next.leaves.identity[slot].id;
            if !is_same || !flies(place.bits) || leaf_state(place.bits) != STATE_FALLING {
                continue;
            }
            let (from, velocity) =
                (Vec3::from(place.position), Vec3::from(world.leaves.drift[slot].velocity));
            let most = longest_way_squared(&cx, velocity, wind_at(&cx, from));
            let way = Vec3::from(there.position) - from;
            longest = longest.max(vec3_dot(way, way) / most);
            bodies += 1;
        }
        world = next;
    }
    assert!(bodies > 100_000 && (0.2..1.0).contains(&longest), "{bodies} bodies, {longest}");
}

/// Ways of all lengths that strike one of the parts of such shapes, and those of which it is foreseen though they begin clear of all.
fn struck_and_foreseen(stands: impl Fn(&ObjectShape) -> bool) -> (u32, u32) {
    let world = still_objects(stands);
    let step = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&step);
    let (mut struck, mut foreseen) = (0, 0);
    for number in 0..200_000 {
        let from = place_among(number);
        let share = |part| centred_share(number, part);
        let along = Vec3::new(share(0.819_172_513_4), share(0.671_043_606_7), share(0.549_700_477_9));
        // Longer ways than those the occupancy grid answers for, too.
        let way = along * [0.2, 0.2, 0.6][number as usize % 3];
        let passage = Passage { from, way, seconds: 0.0, time: 1.0 / 60.0, reach_share: 1.0 };
        let strike = particle_strike(&cx, &passage);
        let may_meet = is_in_reach_of_solids(&cx, from, way);
        if strike.number != NEVER && strike.number != STRIKE_GROUND {
            assert!(may_meet, "{from:?} {way:?} strikes {} at {}", strike.number, strike.share);
            struck += 1;
        }
        let clear_of =
            |part: u32| solid_distance(&cx, &solid_at(&cx, part, 0.0), from).distance_m > CLEAR_OF_SOLIDS_M;
        foreseen += u32::from(may_meet && (0..cx.scene.solids.count).all(clear_of));
    }
    (struck, foreseen)
}
