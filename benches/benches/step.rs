// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of `million`, scaled from a thousand leaves to four million, on every backend. Elements are leaf-steps. The
//! clock stops when the backend is done, not when the steps have been submitted.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{contenders, scaled, sized, time_steps, world};

fn step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    group.sampling_mode(SamplingMode::Flat);
    for leaves in [1_000, 10_000, 100_000, 1_000_000, 4_000_000] {
        group.throughput(Throughput::Elements(leaves.into()));
        group.sample_size(if leaves < 100_000 { 30 } else { 10 });
        for mut simulator in contenders(&world(&scaled("million", sized(leaves)))) {
            let id = BenchmarkId::new(simulator.info().backend, leaves);
            group.bench_function(id, |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
        }
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    step(&mut criterion);
    criterion.final_summary();
}
