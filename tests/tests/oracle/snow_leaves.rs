// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves under snow, and on it.

use glam::Vec2;
use windfall_core::device::leaf::record::lies;
use windfall_core::device::terrain::snow::SNOW_DEPTH_M;
use windfall_core::scene::Litter;
use windfall_core::{World, oracle};

use super::snow::snowy;
use crate::common::steady_wind;

/// A bed of leaves in a wind that takes many of them, under so much snow at -5 °C.
fn windy_bed(lying_mm: f32) -> World {
    let mut scene = snowy(0.0, -5.0, 6.0, 100);
    scene.particles.clear();
    scene.dt_s = 1.0 / 60.0;
    scene.wind = steady_wind(6.0);
    scene.weather.as_mut().expect("stated").lying_mm = lying_mm;
    scene.ground.litter =
        Some(Litter { size_m: Vec2::splat(4.0), leaf_area_index: 0.5, ..Litter::default() });
    World::build(&scene).expect("valid")
}

/// Leaves that lie under a centimetre of snow stay where they are in a wind that takes half of the others, until it has melted.
#[test]
fn snow_holds_leaves_down() {
    let woken = |world: &World| world.litter_stats().expect("there is litter").woken;
    let mut bare = windy_bed(0.0);
    oracle::step(&mut bare, 240);
    let lying = bare.litter_stats().expect("there is litter").lying;
    assert!(woken(&bare) > 200, "the wind takes many: {} of {lying}", woken(&bare));
    let mut covered = windy_bed(1.0);
    oracle::step(&mut covered, 240);
    assert_eq!(woken(&covered), 0, "none of those under snow");
    let block = *covered.compiled.block();
    let snow = covered.bed.snow_mut(&block);
    snow.water.fill(0);
    snow.depth.fill(0);
    oracle::step(&mut covered, 240);
    assert!(woken(&covered) > 200, "the wind takes them when it is gone: {}", woken(&covered));
}

/// A leaf that comes down on snow lies on it, and sinks with it as it melts.
#[test]
fn leaves_lie_on_snow() {
    let mut scene = snowy(0.0, -5.0, 6.0, 100);
    scene.particles.clear();
    scene.dt_s = 1.0 / 60.0;
    scene.weather.as_mut().expect("stated").lying_mm = 8.0;
    scene.ground.litter =
        Some(Litter { size_m: Vec2::splat(4.0), leaf_area_index: 0.0, ..Litter::default() });
    let mut world = World::build(&scene).expect("valid");
    oracle::step(&mut world, 600);
    let depth_m = f64::from(world.bed.snow(world.compiled.block()).depth[0]) * f64::from(SNOW_DEPTH_M);
    assert!(depth_m > 0.1, "{depth_m} m");
    let height_m = |world: &World| f64::from(world.leaves.place[0].position[1]);
    assert!(lies(world.leaves.place[0].bits), "it has come down");
    let above = height_m(&world) - depth_m;
    assert!((-0.005..0.02).contains(&above), "{above} m above the snow");
    let block = *world.compiled.block();
    let snow = world.bed.snow_mut(&block);
    snow.water.fill(0);
    snow.depth.fill(0);
    oracle::step(&mut world, 900);
    assert!(lies(world.leaves.place[0].bits) && height_m(&world) < 0.02, "{} m", height_m(&world));
}
