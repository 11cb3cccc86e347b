// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Memory of a leaf, and of a step: nothing more.

use windfall_core::leaf::{HOT_BYTES_PER_STEP, LEAF_BYTES, Leaves};
use windfall_core::scene::{MeanSpeed, Tree};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

#[test]
fn a_leaf_takes_88_bytes_and_a_step_moves_104() {
    assert_eq!(LEAF_BYTES, 88, "five records of 16 bytes and one of 8");
    assert_eq!(HOT_BYTES_PER_STEP, 104, "place and drift in and out, schedule and air in, attitude out");
    let count = 1 << 20;
    let info = allocation_counter::measure(|| drop(Leaves::zeroed(count)));
    assert_eq!(info.bytes_max, (count * LEAF_BYTES) as u64, "columns and nothing else");
}

#[test]
fn a_step_allocates_nothing() {
    let mut scene = Scene::preset("six-motions").expect("a preset");
    for source in &mut scene.sources {
        source.count = 600;
    }
    let weed = |number| Tree { kind: "weed".into(), number, leaves: 40, ..Tree::default() };
    scene.trees = (0..3).map(weed).collect();
    scene.wind.speed = MeanSpeed::MetresPerSecond(9.0);
    let world = World::build(&scene).expect("a valid scene");
    assert!(
        (10..=256).contains(&world.branches.len()),
        "few enough for one thread: {}",
        world.branches.len()
    );
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads can be started");
    simulator.step(1).expect("the CPU can step");
    let info = allocation_counter::measure(|| simulator.step(500).expect("the CPU can step"));
    assert_eq!(info.count_total, 0, "500 steps of {} leaves", world.leaves.len());
}
