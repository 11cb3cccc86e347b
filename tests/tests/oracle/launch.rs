// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Beginnings of flight: held before release, broken off a twig, or in the air already when time begins.

use crate::common::{GRAVITY, attitude, position, still_scene};
use glam::DVec3;
use windfall_core::arith::Vec3;
use windfall_core::device::flight::regime::{
    REGIME_AUTOROTATION, REGIME_CHAOTIC, REGIME_FLUTTER, REGIME_SPIRAL, REGIME_STEADY, REGIME_TUMBLE,
    regime_after, regime_in_spin, regime_of,
};
use windfall_core::device::leaf::fly::flight_of;
use windfall_core::device::leaf::record::{
    SIZE_ONE, STATE_ATTACHED, body_spin_words, drawn_size, flies, place_bits, twig_sizes,
};
use windfall_core::device::leaf::release::leaf_detach;
use windfall_core::leaf::LeafState;
use windfall_core::scene::{Aerodynamics, FlightModel, Hold, Release, Species};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

const COUNT: u32 = 2000;

fn species(hold: Hold) -> Species {
    let body = Aerodynamics { hold, ..Aerodynamics::default() };
    Species { flight: FlightModel::Aerodynamic(body), ..Species::default() }
}

fn stepped(scene: &Scene, steps: u32) -> World {
    let mut world = World::build(scene).expect("valid");
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    simulator.step(steps).expect("it steps");
    simulator.read_state(&mut world).expect("same size");
    world
}

/// Normals of all bodies just after they have been let go.
fn normals(hold: Hold) -> Vec<DVec3> {
    let world = World::build(&still_scene(species(hold), COUNT, 5.0)).expect("valid");
    (0..COUNT as usize).map(|slot| attitude(&world, slot) * DVec3::Y).collect()
}

#[test]
fn bodies_are_held_as_the_scene_says() {
    let mean = |normals: &[DVec3]| normals.iter().sum::<DVec3>() / f64::from(COUNT);
    let most = 12f64.to_radians();
    let flat = normals(Hold::Broadside);
    assert!(flat.iter().all(|normal| normal.y > most.cos() - 1e-6), "within twelve degrees of flat");
    assert!(flat.iter().any(|normal| normal.y < (0.7 * most).cos()), "but not all alike");
    let upright = normals(Hold::EdgeOn);
    assert!(
        upright.iter().all(|normal| normal.y.abs() < most.sin() + 1e-6),
        "within twelve degrees of upright"
    );
    assert!(mean(&upright).length() < 0.06, "facing all ways: {}", mean(&upright));
    let any = normals(Hold::Random);
    assert!(mean(&any).length() < 0.06, "no way more than another: {}", mean(&any));
    let level = any.iter().map(|normal| normal.y.abs()).sum::<f64>() / f64::from(COUNT);
    assert!((level - 0.5).abs() < 0.03, "heights of points on a sphere are even: {level}");
}

/// A leaf that breaks off its twig goes on with the place, velocity, attitude and spin that it had there, to the bit, and keeps
/// its size.
#[test]
fn a_leaf_takes_its_twigs_motion_along() {
    let world = World::build(&still_scene(species(Hold::Random), 1, 5.0)).expect("valid");
    let step = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&step);
    let mut leaves = world.leaves.clone();
    let mut all = leaves.as_mut();
    let mut leaf = all.row_mut(0);
    leaf.place.bits = place_bits(STATE_ATTACHED, 0, 0, 0, 0);
    leaf.drift.velocity = [0.3, -0.4, 1.7];
    let spin = Vec3::new(2.5, -1.25, 0.75);
    [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(spin);
    leaf.schedule.size = twig_sizes(SIZE_ONE, 40_000);
    let before = flight_of(&leaf);
    leaf_detach(&cx, &mut leaf, 77);
    let after = flight_of(&leaf);
    assert!(flies(leaf.place.bits), "it flies");
    assert_eq!(after.position, before.position, "place");
    assert_eq!(after.velocity, before.velocity, "velocity");
    assert_eq!(after.pose, before.pose, "attitude");
    assert_eq!(after.spin, spin, "spin");
    assert_eq!(drawn_size(leaf.schedule.size), SIZE_ONE, "its own size, not that of its cluster");
}

/// Bodies let go before time zero are then where flying there would have brought them: as many down, and those in the air
/// as high, as if the scene had begun before them.
#[test]
fn bodies_let_go_before_time_zero_are_on_their_way() {
    let mut early = still_scene(species(Hold::Random), COUNT, 3.0);
    early.sources[0].release = Release::Rate { per_s: 400.0, from_s: -5.0 };
    let found = World::build(&early).expect("valid");
    let mut flown = early.clone();
    flown.sources[0].release = Release::Rate { per_s: 400.0, from_s: 0.0 };
    let expected = stepped(&flown, 300);
    let resting = |world: &World| world.stats().leaves.resting;
    let off = f64::from(resting(&found)) - f64::from(resting(&expected));
    assert!(off.abs() < 0.03 * f64::from(COUNT), "{} down, {} if flown", resting(&found), resting(&expected));
    let height = |world: &World| {
        let slots =
            (0..COUNT as usize).filter(|&slot| world.leaves.place[slot].state() == LeafState::Falling);
        let heights: Vec<_> = slots.map(|slot| position(world, slot).y).collect();
        heights.iter().sum::<f64>() / heights.len() as f64
    };
    assert!((height(&found) - height(&expected)).abs() < 0.1, "{} {}", height(&found), height(&expected));
    assert!(found.stats().leaves.resting > 100 && found.stats().leaves.falling > 100, "{:?}", found.stats());
    assert_eq!(found.stats().leaves.broken, 0, "all of them somewhere");
}

/// Classification of made-up motions whose regime is known.
#[test]
fn regimes_are_told_from_motion() {
    let classified = |motion: &dyn Fn(f64) -> [DVec3; 3]| {
        let mut memory = 0u32;
        let mut ticks = 0;
        for step in 1..900u32 {
            let [flow, spin, path] =
                motion(f64::from(step) / 60.0).map(|v| Vec3::from(v.as_vec3().to_array()));
            let now = step * 16 / 60;
            memory = regime_after(memory, flow, spin, path, now - ticks, 15);
            ticks = now;
        }
        regime_of(memory)
    };
    let steady = |_: f64| [DVec3::new(0.02, -0.8, 0.01), DVec3::ZERO, DVec3::new(0.02, -0.8, 0.01)];
    assert_eq!(classified(&steady), REGIME_STEADY, "nearly straight down");
    let tumble = |t: f64| {
        let (sine, cosine) = (15.0 * t).sin_cos();
        let path = DVec3::new(0.6, -0.76, 0.05);
        let flow = DVec3::new(cosine * path.x + sine * path.y, cosine * path.y - sine * path.x, 0.05);
        [flow, DVec3::new(0.1, 0.0, 15.0), path]
    };
    assert_eq!(classified(&tumble), REGIME_TUMBLE, "over and over");
    // Banked so that its force points along its normal.
    let flutter = |t: f64| {
        let (sine, cosine) = (6.8 * t).sin_cos();
        let path = DVec3::new(-0.8 * sine, -0.76, 0.0);
        let normal = DVec3::new(-0.8 * 6.8 * cosine, GRAVITY, 0.0).normalize();
        let across = DVec3::new(normal.y, -normal.x, 0.0);
        [DVec3::new(path.dot(across), path.dot(normal), 0.0), DVec3::new(0.1, 0.0, 0.1), path]
    };
    assert_eq!(classified(&flutter), REGIME_FLUTTER, "to and fro");
    // Over one way, back the other way.
    let mixed = |t: f64| {
        let way = if (t * 1.25).fract() < 0.5 { 1.0 } else { -1.0 };
        let (sine, cosine) = (12.0 * ((t * 1.25).fract() * 0.8 - 0.4).abs()).sin_cos();
        let path = DVec3::new(0.6 * way, -0.76, 0.05);
        let flow = DVec3::new(cosine * path.x + sine * path.y, cosine * path.y - sine * path.x, 0.05);
        [flow, DVec3::new(0.1, 0.0, 12.0 * way), path]
    };
    assert_eq!(classified(&mixed), REGIME_CHAOTIC, "now this way, now that");
}

/// A seed of 4 cm whose tips go round at twice its descent autorotates, a smaller one as fast in spin or one about an axis across its fall
/// does not; what swings or turns over keeps its name.
#[test]
fn an_autorotation_is_told_by_its_tips() {
    let flow = Vec3::new(0.1, -0.99, 0.1);
    let about_fall = Vec3::new(-9.0, 89.1, -9.0);
    for idle in [REGIME_STEADY, REGIME_SPIRAL] {
        assert_eq!(regime_in_spin(idle, flow, about_fall, 0.02), REGIME_AUTOROTATION, "1.8 m/s at its tips");
        assert_eq!(regime_in_spin(idle, flow, about_fall, 0.012), idle, "1.08 m/s at its tips");
        assert_eq!(regime_in_spin(idle, flow, Vec3::new(89.1, 9.0, 0.0), 0.02), idle, "about an axis across");
    }
    for lively in [REGIME_FLUTTER, REGIME_TUMBLE, REGIME_CHAOTIC] {
        assert_eq!(regime_in_spin(lively, flow, about_fall, 0.02), lively, "not idle");
    }
}
