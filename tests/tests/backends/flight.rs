// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that fly as bodies, beside synthesised ones, from trees and from boxes: CPU and GPU, step by step and for long.

use windfall_core::device::leaf::record::flies;

use windfall_core::{Contract, World};
use windfall_cpu::{CpuOptions, Simd};
use windfall_tests::adapter;
use windfall_tests::compare::difference;
use windfall_tests::strategies::flying_scene;
use windfall_wgpu::WgpuOptions;

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

const LEAVES: u32 = 4000;
const STEPS: u32 = 1000;

fn world() -> World {
    World::build(&flying_scene(1854, LEAVES, 5.0, 1.0 / 60.0)).expect("the flying scene is valid")
}

fn bodies(world: &World) -> usize {
    world.leaves.place.iter().filter(|place| flies(place.bits)).count()
}

#[test]
fn a_thousand_steps_are_equal_to_the_bit_under_the_exact_contract() {
    let world = world();
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    let stats = oracle.stats();
    assert!(bodies(&world) > 300 && bodies(&oracle) > 300, "bodies fly: {stats:?}");
    assert!(stats.leaves.resting > 500 && stats.leaves.broken == 0, "and land: {stats:?}");
    for gpu in exact_adapters() {
        let candidate = on_gpu(&gpu, &world, &exact(None), &[STEPS]);
        let found = difference(&oracle, &candidate);
        assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
        assert_eq!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
    }
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_bits() {
    let world = world();
    let plain = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 300);
    for simd in Simd::available() {
        for threads in [1, 3] {
            let options = CpuOptions { simd: Some(simd), threads: Some(threads) };
            let found = on_cpu(&world, options, 300);
            assert_eq!(found.state_hash(), plain.state_hash(), "{simd:?} on {threads} threads");
        }
    }
}

/// Flight is chaos: under the tolerant contract paths part, but as many land, fall as fast and fall in the same ways.
#[test]
fn under_the_tolerant_contract_the_statistics_agree() {
    let world = world();
    let expected = on_cpu(&world, CpuOptions::default(), STEPS);
    let height = |world: &World| {
        let flying = world.leaves.place.iter().filter(|place| flies(place.bits));
        flying.map(|place| f64::from(place.position[1])).sum::<f64>() / bodies(world) as f64
    };
    for gpu in adapter::all() {
        let options = WgpuOptions { contract: Some(Contract::Tolerant), ..WgpuOptions::default() };
        let found = on_gpu(&gpu, &world, &options, &[STEPS]);
        let (a, b) = (found.stats(), expected.stats());
        let off = a.leaves.resting.abs_diff(b.leaves.resting);
        assert!(off < 60, "{}: {} rest, expected {}", gpu.info().name, a.leaves.resting, b.leaves.resting);
        for (regime, (a, b)) in a.leaves.regimes.iter().zip(b.leaves.regimes).enumerate() {
            // Five standard deviations of the difference of two such counts.
            let usual = 5.0 * f64::from(2 * b.max(10)).sqrt();
            assert!(f64::from(a.abs_diff(b)) < usual, "{}: regime {regime}: {a} and {b}", gpu.info().name);
        }
        let (a, b) = (height(&found), height(&expected));
        assert!((a - b).abs() < 0.3, "{}: mean heights {a} and {b} m", gpu.info().name);
    }
}
