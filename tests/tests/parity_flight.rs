// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that fly as bodies, beside synthesised ones, from trees and from boxes: CPU and GPU, step by step and for long.

use windfall_core::leaf::fly::flies;

use windfall_core::{Contract, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator, Simd};
use windfall_tests::adapter;
use windfall_tests::compare::{Difference, difference};
use windfall_tests::strategies::flying_scene;
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator};

const LEAVES: u32 = 4000;
const STEPS: u32 = 1000;

fn world() -> World {
    World::build(&flying_scene(1854, LEAVES, 5.0, 1.0 / 60.0)).expect("the flying scene is valid")
}

fn oracle(world: &World, options: CpuOptions, steps: u32) -> World {
    let mut result = world.clone();
    let mut simulator = CpuSimulator::new(world, options).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.read_state(&mut result).expect("same size");
    result
}

fn candidate(gpu: &Gpu, world: &World, options: &WgpuOptions, steps: u32) -> World {
    let mut result = world.clone();
    let mut simulator = WgpuSimulator::new(gpu, world, options).expect("the device takes the world");
    simulator.step(steps).expect("it steps");
    simulator.read_state(&mut result).expect("same size");
    assert_eq!(simulator.stats().expect("counts"), result.stats(), "counts of the device");
    result
}

fn bodies(world: &World) -> usize {
    world.leaves.place.iter().filter(|place| flies(place.bits)).count()
}

#[test]
fn a_thousand_steps_are_equal_to_the_bit_under_the_exact_contract() {
    let world = world();
    let oracle = oracle(&world, CpuOptions::default(), STEPS);
    let stats = oracle.stats();
    assert!(bodies(&world) > 300 && bodies(&oracle) > 300, "bodies fly: {stats:?}");
    assert!(stats.resting > 500 && stats.broken == 0, "and land: {stats:?}");
    for (gpu, contract) in adapter::contracts() {
        if contract != Contract::Exact {
            continue;
        }
        let options = WgpuOptions { contract: Some(contract), ..WgpuOptions::default() };
        let candidate = candidate(&gpu, &world, &options, STEPS);
        assert_eq!(difference(&oracle, &candidate), Difference::default(), "{}", gpu.info().name);
        assert_eq!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
    }
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_bits() {
    let world = world();
    let plain = oracle(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 300);
    for simd in Simd::available() {
        for threads in [1, 3] {
            let options = CpuOptions { simd: Some(simd), threads: Some(threads) };
            let found = oracle(&world, options, 300);
            assert_eq!(found.state_hash(), plain.state_hash(), "{simd:?} on {threads} threads");
        }
    }
}
