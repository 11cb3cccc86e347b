// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A million flakes beside a million leaves in the same wind, and snow that lies on 1,600 x 1,600 cells: in calm air and where wind drifts it,
//! over whole rounds of exchanges. Elements are flake-steps, leaf-steps and cell-steps.

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{contenders, falling, lying_snow, snowfall, time_steps, world};
use windfall_core::World;
use windfall_core::device::terrain::snow::{DRIFT_ROUNDS, SNOW_INTERVAL, SNOW_TURNS};

/// Flakes, or leaves.
const FLAKES: u32 = 1_000_000;
/// Cells along an edge.
const CELLS: u32 = 1_600;
/// Steps after which exchanges repeat.
const ROUND_STEPS: u32 = SNOW_INTERVAL * SNOW_TURNS * DRIFT_ROUNDS;

/// Times a world on every backend, in runs of so many steps.
fn on_backends(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, world: &World, run: u32) {
    for mut simulator in contenders(world) {
        group.bench_function(BenchmarkId::new(name, simulator.info().backend), |bencher| {
            bencher.iter_custom(|count| {
                let elapsed = time_steps(simulator.as_mut(), count * u64::from(run));
                elapsed / run
            });
        });
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("snow");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(FLAKES.into()));
    on_backends(&mut group, "leaves", &world(&falling(FLAKES)), 1);
    on_backends(&mut group, "flakes", &world(&snowfall(FLAKES)), 1);
    group.throughput(Throughput::Elements((CELLS * CELLS).into()));
    for (name, wind_m_s) in [("cells", 2.0), ("drifting_cells", 14.0)] {
        on_backends(&mut group, name, &world(&lying_snow(wind_m_s)), ROUND_STEPS);
    }
    group.finish();
    criterion.final_summary();
}
