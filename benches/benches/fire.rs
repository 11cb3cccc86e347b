// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bonfire with about a hundred thousand embers in the air, which stick to its branches or pass through them, and without any; and a hundred thousand leaves
//! in dry litter of which some burn. Elements are steps.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode};
use windfall_benches::{bonfire, burning, contenders, time_steps, world};
use windfall_core::scene::Meets;
use windfall_core::{Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Embers born a second: they live for a second and a half in the mean.
const EMBERS_PER_S: f32 = 66_000.0;
const LEAVES: u32 = 100_000;
/// Steps after which many leaves burn.
const LIT_STEPS: u32 = 900;

/// The world of a fire some steps on.
fn lit(world: World) -> World {
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads can be started");
    simulator.step(LIT_STEPS).expect("the CPU steps");
    let lit = simulator.world().clone();
    eprintln!("{:?}", lit.burn_stats());
    lit
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("fire");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(5));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    let worlds = [
        ("no_embers", world(&bonfire(130.0, Meets::Stick))),
        ("free_embers", world(&bonfire(EMBERS_PER_S, Meets::Nothing))),
        ("embers", world(&bonfire(EMBERS_PER_S, Meets::Stick))),
        ("burning", lit(world(&burning(LEAVES)))),
    ];
    for (name, world) in &worlds {
        for mut simulator in contenders(world) {
            group.bench_function(BenchmarkId::new(*name, simulator.info().backend), |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
        }
    }
    group.finish();
    criterion.final_summary();
}
