// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that fly as bodies beside the same leaves synthesised, all of them falling through turbulent air, on every
//! backend. Elements are leaf-steps.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{contenders, falling, flying, sized, time_steps, world};

/// Steps after which the world begins anew: slow bodies have not landed by then, nor fast ones lost their spread.
const STEPS: u64 = 600;

fn flight(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flight");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for whole in [100_000, 1_000_000] {
        group.throughput(Throughput::Elements(whole.into()));
        let leaves = sized(whole);
        for (name, scene) in [("synthesised", falling(leaves)), ("bodies", flying(leaves))] {
            let start = world(&scene);
            for mut simulator in contenders(&start) {
                let id = BenchmarkId::new(format!("{name}/{}", simulator.info().backend), whole);
                group.bench_function(id, |bencher| {
                    bencher.iter_custom(|count| {
                        let mut elapsed = Duration::ZERO;
                        let mut left = count;
                        while left > 0 {
                            let batch = left.min(STEPS.saturating_sub(simulator.clock().step().into()));
                            if batch == 0 {
                                simulator.write_state(&start).expect("the same number of leaves");
                                time_steps(simulator.as_mut(), 1);
                            }
                            elapsed += time_steps(simulator.as_mut(), batch);
                            left -= batch;
                        }
                        elapsed
                    });
                });
                let stats = simulator.stats().expect("the device is not lost");
                assert_eq!(stats.leaves.falling, leaves, "all leaves have been falling all the time");
            }
        }
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    flight(&mut criterion);
    criterion.final_summary();
}
