// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid parts that a particle may meet on its way: none that it strikes is passed over.
#![expect(clippy::cast_possible_truncation, reason = "shares fit single precision")]

use windfall_core::World;
use windfall_core::arith::Vec3;
use windfall_core::blocks::NEVER;
use windfall_core::device::flight::strike::Passage;
use windfall_core::device::particle::step::is_in_reach_of_solids;
use windfall_core::device::particle::strike::{STRIKE_GROUND, particle_strike};
use windfall_core::device::solid::distance::solid_distance;
use windfall_core::device::solid::near::CLEAR_OF_SOLIDS_M;
use windfall_core::device::solid::shape::solid_at;
use windfall_core::scene::{ObjectMotion, ObjectShape};
use windfall_tests::strategies::obstructed_scene;

/// Whatever a way strikes is foreseen by the test that decides if contacts are looked for; of ways that only pass by boxes, cylinders, balls and
/// capsules, few are taken for such.
#[test]
fn what_a_way_strikes_is_foreseen() {
    let mut scene = obstructed_scene(6, 30, 0.0, 1.0 / 60.0);
    scene.walkers.clear();
    scene.objects.iter_mut().for_each(|object| object.motion = ObjectMotion::Still);
    // Polyhedra and meshes are met as spheres around them.
    scene
        .objects
        .retain(|object| !matches!(object.shape, ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. }));
    let world = World::build(&scene).expect("valid without what moves");
    let step = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&step);
    let (mut struck, mut foreseen) = (0, 0);
    for number in 0..200_000 {
        let share = |part: f64| ((f64::from(number) * part).fract() - 0.5) as f32;
        let from = Vec3::new(
            7.0 * share(0.618_033_988_7),
            0.9 + 1.7 * share(0.754_877_666_2),
            7.0 * share(0.569_840_290_9),
        );
        let along = Vec3::new(share(0.819_172_513_4), share(0.671_043_606_7), share(0.549_700_477_9));
        let way = along * 0.2;
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
    assert!(struck > 5000 && foreseen < struck + struck / 5, "{struck} strike, {foreseen} might");
}
