// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow: a grid of 1,600 x 1,600 cells that lies, in a calm and in a storm that takes it along, with cell-steps for elements, averaged over
//! whole turns of its work; and a million flakes that fall and land, beside as many synthesised leaves in the same air.

use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{SNOWING_STEPS, contenders, falling, sized, snowed, snowing, stepped, world};
use windfall_core::World;
use windfall_core::device::terrain::snow::{DRIFT_ROUNDS, SNOW_CELLS_PER_M, SNOW_INTERVAL, SNOW_TURNS};

/// Edge in m of the grid.
const EDGE_M: f32 = 200.0;
/// Flakes, and leaves.
const FLAKES: u32 = 1_000_000;
/// Steps in which snow slides, ages and drifts once.
const WHOLE_TURN: u32 = SNOW_INTERVAL * SNOW_TURNS * DRIFT_ROUNDS;

/// Times a world on every backend: steps, averaged over so many that are asked for at once.
fn on_backends(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, world: &World, steps: u32) {
    for mut simulator in contenders(world) {
        let id = BenchmarkId::new(name, simulator.info().backend);
        group.bench_function(id, |bencher| {
            bencher.iter_custom(|count| -> Duration {
                let start = Instant::now();
                for _ in 0..count {
                    simulator.step(steps).expect("the device is not lost");
                    simulator.sync().expect("the device is not lost");
                }
                start.elapsed() / steps
            });
        });
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("snow");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    let edge = f64::from(EDGE_M * SNOW_CELLS_PER_M);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of cells")]
    group.throughput(Throughput::Elements((edge * edge) as u64));
    on_backends(&mut group, "lying", &world(&snowed(EDGE_M, 0.0)), WHOLE_TURN);
    on_backends(&mut group, "drifting", &world(&snowed(EDGE_M, 15.0)), WHOLE_TURN);
    group.throughput(Throughput::Elements(FLAKES.into()));
    let flakes = sized(FLAKES);
    let worlds = [("flakes", stepped(&snowing(flakes), SNOWING_STEPS)), ("leaves", world(&falling(flakes)))];
    for (name, world) in &worlds {
        on_backends(&mut group, name, world, 1);
        on_backends(&mut group, &format!("{name}_in_eights"), world, 8);
    }
    group.finish();
    criterion.final_summary();
}
