// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whole worlds at random: the same bits on both backends, with one thread and three, two sets of instructions, and resumed halfway.
//!
//! `WINDFALL_WORLDS` is their number, fifty if it is not set, and `WINDFALL_FIRST_WORLD` the seed of the first.

use std::panic::{AssertUnwindSafe, catch_unwind};

use windfall_core::{Contract, World};
use windfall_cpu::{CpuOptions, Simd};
use windfall_tests::random_world::random_world;
use windfall_wgpu::Gpu;

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

/// Steps of a world, of which half before it is resumed.
const STEPS: u32 = 24;
/// Seeds of worlds that once differed or broke, and why; they are tested in every run.
const KEPT: [(u64, &str); 1] =
    [(10_792, "particles that attract one another by nothing had no kernel on the device")];

/// Value of a variable, or what stands for it.
fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().expect("a whole number"))
}

/// A difference between the ways to step a world, in words.
fn difference(seed: u64, gpus: &[Gpu]) -> Option<String> {
    let (scene, world) = random_world(seed);
    let options = |threads, simd| CpuOptions { threads: Some(threads), simd };
    let sets = Simd::available();
    #[expect(clippy::cast_possible_truncation, reason = "less than the number of sets")]
    let other = sets[(seed % sets.len() as u64) as usize];
    let first = on_cpu(&world, options(1, Some(Simd::best())), STEPS);
    let broken = first.stats().leaves.broken;
    if broken > 0 {
        return Some(format!("{broken} leaves are nowhere:\n{}", scene.to_ron()));
    }
    let hash = first.state_hash();
    let half = on_cpu(&world, options(2, Some(Simd::best())), STEPS / 2);
    let mut checkpoint = Vec::new();
    half.write_checkpoint(&mut checkpoint).expect("memory takes it");
    let half = World::from_checkpoint(&checkpoint, "halfway").expect("it is one");
    let ways = [
        ("three threads", on_cpu(&world, options(3, Some(Simd::best())), STEPS)),
        ("another set of instructions", on_cpu(&world, options(1, Some(other)), STEPS)),
        ("resumed halfway", on_cpu(&half, options(1, Some(Simd::best())), STEPS - STEPS / 2)),
    ];
    let on_gpus =
        gpus.iter().map(|gpu| ("the device", on_gpu(gpu, &world, &exact(None), &[1, 7, STEPS - 8])));
    let mut ways = ways.into_iter().chain(on_gpus);
    let (way, _) = ways.find(|(_, world)| world.state_hash() != hash)?;
    Some(format!("{way} ({other:?}) differs:\n{}", scene.to_ron()))
}

#[test]
fn random_worlds_are_the_same_everywhere() {
    let gpus = exact_adapters();
    assert!(gpus.iter().all(|gpu| gpu.contract() == Contract::Exact), "to the bit");
    let first = setting("WINDFALL_FIRST_WORLD", 0);
    let seeds = KEPT.iter().map(|(seed, _)| *seed).chain(first..first + setting("WINDFALL_WORLDS", 50));
    let failures: Vec<String> = seeds
        .filter_map(|seed| {
            let found = catch_unwind(AssertUnwindSafe(|| difference(seed, &gpus)));
            let text = found.unwrap_or_else(|_| Some("it panics, as said above".into()))?;
            Some(format!("world {seed}: {text}"))
        })
        .collect();
    assert!(failures.is_empty(), "{} worlds differ:\n{}", failures.len(), failures.join("\n"));
}
