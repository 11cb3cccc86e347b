// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of a million leaves in the litter: in still air, in winds that wake a few or nearly all, and beside them a million leaves
//! that fall and that fly as bodies. Elements are leaf-steps; what lies and what is awake is printed.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{contenders, falling, flying, littered, sized, stepped, time_steps, world};
use windfall_core::device::leaf::wake::COVER_INTERVAL;
use windfall_core::{Scene, Simulator, World};

const LEAVES: u32 = 1_000_000;
/// Edge in m of a lawn on which the leaves lie singly.
const LOOSE_M: f32 = 200.0;
/// Edge in m of one on which they lie twenty layers deep, and a gusty wind.
const DEEP_M: f32 = 11.9;
const DEEP_M_S: f32 = 5.5;
/// Steps until as many leaves are awake as the wind keeps awake.
const SETTLED_STEPS: u32 = 300;
/// Steps of deep litter after which a gust comes: ten thousand are awake in the mean over [`DEEP_STEPS`] from there on, and ten times as many
/// later.
const DEEP_START: u32 = 440;
const DEEP_STEPS: u32 = 80;

/// The world of a scene some steps on; prints what lies there.
fn settled(scene: &Scene, steps: u32) -> World {
    let settled = stepped(scene, steps);
    eprintln!("{}: {:?}", scene.name, settled.litter_stats());
    settled
}

/// Times the same [`DEEP_STEPS`] again and again. Off the clock before them: what lies where is learnt anew from a state that is written.
fn time_deep(simulator: &mut dyn Simulator, before: &World, count: u64) -> Duration {
    let mut elapsed = Duration::ZERO;
    let mut left = count;
    while left > 0 {
        let batch = left.min(DEEP_STEPS.into());
        simulator.write_state(before).expect("the same number of leaves");
        simulator.step(COVER_INTERVAL).expect("the device is not lost");
        simulator.sync().expect("the device is not lost");
        elapsed += time_steps(simulator, batch);
        left -= batch;
    }
    elapsed
}

fn litter(criterion: &mut Criterion) {
    let leaves = sized(LEAVES);
    let mut group = criterion.benchmark_group("litter");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sampling_mode(SamplingMode::Flat).sample_size(10).throughput(Throughput::Elements(leaves.into()));
    // As many leaves on a square metre however many there are.
    let [loose_m, deep_m] = [LOOSE_M, DEEP_M].map(|edge_m| edge_m * (leaves as f32 / LEAVES as f32).sqrt());
    let worlds = [
        ("falling", world(&falling(leaves))),
        ("bodies", world(&flying(leaves))),
        ("calm", settled(&littered(leaves, loose_m, 0.0), SETTLED_STEPS)),
        ("breeze", settled(&littered(leaves, loose_m, 3.0), SETTLED_STEPS)),
        ("gale", settled(&littered(leaves, loose_m, 18.0), SETTLED_STEPS)),
        ("deep", settled(&littered(leaves, deep_m, DEEP_M_S), DEEP_START - COVER_INTERVAL)),
    ];
    for (name, world) in &worlds {
        for mut simulator in contenders(world) {
            let id = BenchmarkId::new(*name, simulator.info().backend);
            group.bench_function(id, |bencher| {
                bencher.iter_custom(|count| match *name {
                    "deep" => time_deep(simulator.as_mut(), world, count),
                    _ => time_steps(simulator.as_mut(), count),
                });
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
