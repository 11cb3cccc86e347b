// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Response of a leaf to gravity, the wind and the two speeds of a scene.

use std::f64::consts::TAU;

use crate::common::{
    GRAVITY, build, position, single_motion, steady_wind, step, still_scene, uniform_species, vector,
    velocity,
};
use glam::DVec3;
use windfall_core::device::leaf::record::leaf_stage;
use windfall_core::motion::{MotionConstants, Primitive};
use windfall_core::scene::{MeanSpeed, STANDARD_GRAVITY_M_S2, Scene};
use windfall_core::{CompiledScene, World};

#[test]
fn a_released_leaf_starts_at_rest_and_falls_like_a_stone_at_first() {
    let mut scene = still_scene(uniform_species(), 200, 10.0);
    scene.dt_s = 0.001;
    let species = &mut scene.species[0];
    species.motion.wander_m_s = Some(0.0);
    let constants = MotionConstants::of(species, STANDARD_GRAVITY_M_S2);
    let mut world = build(&scene);
    let first_stage = |world: &World, slot: usize| leaf_stage(world.leaves.identity[slot].appearance) == 0;
    for slot in 0..200 {
        assert_eq!(velocity(&world, slot), DVec3::ZERO, "leaf {slot} is let go at rest");
        assert_eq!(position(&world, slot), DVec3::new(0.0, 10.0, 0.0), "leaf {slot} is let go at its place");
    }
    for steps in 1..=300 {
        step(&mut world, 1);
        let time = 0.001 * f64::from(steps);
        let tau = constants.response_s();
        let expected = -constants.descent_m_s * (1.0 - (-time / tau).exp());
        for slot in (0..200).filter(|&slot| first_stage(&world, slot)) {
            let fall = velocity(&world, slot).y;
            assert!(
                (fall - expected).abs() < 2e-4,
                "leaf {slot} after {time} s: {fall}, expected {expected} m/s"
            );
        }
        if steps == 2 {
            let acceleration = -velocity(&world, 0).y / time;
            assert!((acceleration / GRAVITY - 1.0).abs() < 0.02, "first acceleration {acceleration} m/s²");
        }
    }
}

/// Wind adds to the path what a leaf with response time U/g makes of it, and nothing else.
#[test]
fn leaves_follow_a_steady_wind_within_their_response_time() {
    for primitive in Primitive::JOINED {
        let scene = still_scene(single_motion(primitive), 50, 15.0);
        let tau = MotionConstants::of(&scene.species[0], STANDARD_GRAVITY_M_S2).response_s();
        let mut still = build(&scene);
        let mut windy = build(&Scene { wind: steady_wind(4.0), ..scene.clone() });
        for steps in 1..=600u32 {
            step(&mut still, 1);
            step(&mut windy, 1);
            let time = still.clock.seconds();
            let share = 1.0 - (-time / tau).exp();
            for slot in 0..50 {
                let carried = position(&windy, slot) - position(&still, slot);
                let expected = DVec3::X * (4.0 * (time - tau * share));
                let error = (carried - expected).length();
                assert!(
                    error < 1e-3,
                    "{primitive:?} after {time:.2} s: carried {carried}, expected {expected}"
                );
                let gained = velocity(&windy, slot) - velocity(&still, slot);
                let error = (gained - DVec3::X * (4.0 * share)).length();
                assert!(error < 1e-4, "{primitive:?} after {time:.3} s: gained {gained}, share {share}");
                let mean = carried.x / time;
                assert!(
                    steps < 500 || (mean / 4.0 - 1.0).abs() < 0.01,
                    "{primitive:?}: mean drift {mean} m/s"
                );
            }
        }
    }
}

/// The wind turns in mid-fall: 63 % of the change within U/g.
#[test]
fn the_response_to_a_step_of_the_wind_is_exponential() {
    let mut scene = still_scene(single_motion(Primitive::SteadyDescent), 1, 15.0);
    scene.dt_s = 0.002;
    scene.wind = steady_wind(2.0);
    let tau = MotionConstants::of(&scene.species[0], STANDARD_GRAVITY_M_S2).response_s();
    // A join would hand on a difference of wandering.
    scene.species[0].motion.wander_m_s = Some(0.0);
    let mut world = build(&scene);
    step(&mut world, 1000);
    scene.wind.direction_deg = 90.0;
    scene.wind.speed = MeanSpeed::MetresPerSecond(5.0);
    let turned = CompiledScene::compile(&scene).expect("the scene of this test is valid");
    world.compiled = turned;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "about forty steps")]
    let steps = (tau / 0.002).round() as u32;
    step(&mut world, steps);
    let drift = vector(world.leaves.drift[0].velocity);
    let share = 1.0 - (-0.002 * f64::from(steps) / tau).exp();
    let expected = DVec3::new(2.0 * (1.0 - share), 0.0, 5.0 * share);
    assert!((share - 0.632).abs() < 0.01, "one time constant: {share}");
    assert!((drift - expected).length() < 1e-3, "after one time constant: {drift}, expected {expected}");
}

/// The fall speed multiplies every velocity of a leaf's own motion, the rotation speed its rate and not its speed: so
/// the same swings become longer or shorter.
#[test]
fn fall_speed_and_rotation_speed_scale_what_they_say() {
    for primitive in Primitive::JOINED {
        // So high that the first stage of a fall lasts for minutes.
        let base = still_scene(single_motion(primitive), 40, 400.0);
        let period =
            windfall_core::motion::MotionTables::generate(&base.species[0], [1, 0], STANDARD_GRAVITY_M_S2).0
                [primitive as usize]
                .period_s;
        for (fall_speed, rotation_speed) in
            [(1.0f32, 1.0f32), (0.5, 1.0), (2.0, 1.0), (1.0, 0.5), (1.0, 2.0), (1.5, 0.7)]
        {
            let scene = Scene { fall_speed, rotation_speed, dt_s: 0.01, ..base.clone() };
            let (fall, turn) = (f64::from(fall_speed), f64::from(rotation_speed));
            let mut world = build(&scene);
            let u = MotionConstants::of(&scene.species[0], STANDARD_GRAVITY_M_S2).descent_m_s;
            step(&mut world, 200);
            let phase =
                |world: &World, slot: usize| f64::from(world.leaves.drift[slot].phase) / 4_294_967_296.0;
            let start: Vec<_> = (0..40).map(|slot| (position(&world, slot), phase(&world, slot))).collect();
            // Whole periods as nearly as steps allow; a step more or less is a hundredth of a second's way.
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "about a thousand steps"
            )]
            let steps = ((8.0 * turn / period).ceil() * period / turn / 0.01).round() as u32;
            step(&mut world, steps);
            let time = 0.01 * f64::from(steps);
            let expected = (time * turn / period).rem_euclid(1.0);
            let unbroken = |slot: &usize| leaf_stage(world.leaves.identity[*slot].appearance) == 0;
            let slots: Vec<_> = (0..40).filter(unbroken).collect();
            assert!(slots.len() > 20, "{} of 40 leaves are in their first stage", slots.len());
            for slot in slots {
                let (place, old) = start[slot];
                let descent = (place.y - position(&world, slot).y) / time;
                let error = (descent / (u * fall) - 1.0).abs();
                assert!(error < 0.01, "{primitive:?}, fall {fall}, rotation {turn}: {descent} m/s, U = {u}");
                let advanced = (phase(&world, slot) - old).rem_euclid(1.0);
                let off = (advanced - expected + 0.5).rem_euclid(1.0) - 0.5;
                assert!(off.abs() < 1e-3, "{primitive:?}, rotation {turn}: phase is {off} periods off");
            }
        }
    }
    // A spiral of half the rate at the same speed is twice as wide.
    let width = |rotation_speed: f32| {
        let base = still_scene(single_motion(Primitive::PeriodicSpiraling), 1, 400.0);
        let rate = MotionConstants::of(&base.species[0], STANDARD_GRAVITY_M_S2).spiral_rad_s;
        let mut world = build(&Scene { rotation_speed, ..base });
        step(&mut world, 120);
        let mut low = DVec3::MAX;
        let mut high = DVec3::MIN;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred steps")]
        let orbit = (TAU / rate / f64::from(rotation_speed) * 60.0).ceil() as u32;
        for _ in 0..=orbit {
            step(&mut world, 1);
            low = low.min(position(&world, 0));
            high = high.max(position(&world, 0));
        }
        high.x - low.x
    };
    let ratio = width(0.5) / width(1.0);
    assert!((ratio - 2.0).abs() < 0.02, "the spiral of half the rate is {ratio} times as wide");
}
