// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of a million leaves in the litter: in still air, in winds that wake a few or nearly all, and beside them a million leaves
//! that fall and that fly as bodies. Elements are leaf-steps; what lies and what is awake is printed.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{contenders, falling, flying, littered, time_steps, world};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

const LEAVES: u32 = 1_000_000;
/// Edge in m of a lawn on which the leaves lie singly.
const LOOSE_M: f32 = 200.0;
/// Edge in m of one on which they lie twenty layers deep, and the wind that keeps ten thousand awake there.
const DEEP_M: f32 = 11.9;
const DEEP_M_S: f32 = 5.5;
/// Steps until as many leaves are awake as the wind keeps awake.
const SETTLED_STEPS: u32 = 300;

/// The world of a scene some seconds on.
fn settled(scene: &Scene) -> World {
    let start = world(scene);
    let mut simulator = CpuSimulator::new(&start, CpuOptions::default()).expect("threads can be started");
    simulator.step(SETTLED_STEPS).expect("the CPU steps");
    let settled = simulator.world().clone();
    eprintln!("{}: {:?}", scene.name, settled.litter_stats());
    settled
}

fn litter(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("litter");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sampling_mode(SamplingMode::Flat).sample_size(10).throughput(Throughput::Elements(LEAVES.into()));
    let worlds = [
        ("falling", world(&falling(LEAVES))),
        ("bodies", world(&flying(LEAVES))),
        ("calm", settled(&littered(LEAVES, LOOSE_M, 0.0))),
        ("breeze", settled(&littered(LEAVES, LOOSE_M, 3.0))),
        ("gale", settled(&littered(LEAVES, LOOSE_M, 18.0))),
        ("deep", settled(&littered(LEAVES, DEEP_M, DEEP_M_S))),
    ];
    for (name, world) in &worlds {
        for mut simulator in contenders(world) {
            let id = BenchmarkId::new(*name, simulator.info().backend);
            group.bench_function(id, |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
        }
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    litter(&mut criterion);
    criterion.final_summary();
}
