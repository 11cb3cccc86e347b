// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The kernels on every backend, each on worlds that show one side of it, and the costly device functions on one
//! thread of the CPU. Elements are leaves, or calls.
//!
//! `advance` includes `resolve_events`, which takes the leaves with an event: nearly none in `falling` and
//! `steady` (without turbulence), none in `resting`, in `storm` the joins and releases of a usual scene, in a wind with
//! two vortices, and a sixth of all leaves in `restless`.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{
    FALLING_STEPS, contenders, falling, resting, restless, scaled, steady, time_steps, world,
};
use windfall_core::arith::rng::philox;
use windfall_core::device::leaf::own::{motion_params, own_advance, own_orientation};
use windfall_core::device::leaf::release::leaf_release;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::{LeafState, Leaves};
use windfall_core::{Simulator, World};

/// Leaves of a kernel's world.
const LEAVES: u32 = 100_000;
/// Calls of a device function in a row; their inputs fit in the first-level cache.
const CALLS: usize = 256;

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group
}

/// Steps of which none begins later than [`FALLING_STEPS`]: before that the world begins anew, off the clock.
fn time_falling(simulator: &mut dyn Simulator, world: &World, count: u64) -> Duration {
    let mut elapsed = Duration::ZERO;
    let mut left = count;
    while left > 0 {
        let batch = left.min(u64::from(FALLING_STEPS.saturating_sub(simulator.clock().step())));
        if batch == 0 {
            simulator.write_state(world).expect("the same number of leaves");
            // The upload travels with the next submission.
            time_steps(simulator, 1);
        }
        elapsed += time_steps(simulator, batch);
        left -= batch;
    }
    elapsed
}

fn advance(criterion: &mut Criterion) {
    let mut group = group(criterion, "advance");
    group.throughput(Throughput::Elements(LEAVES.into()));

    for (name, scene) in [("falling", falling(LEAVES)), ("steady", steady(LEAVES))] {
        let high = world(&scene);
        for mut simulator in contenders(&high) {
            group.bench_function(BenchmarkId::new(name, simulator.info().backend), |bencher| {
                bencher.iter_custom(|count| time_falling(simulator.as_mut(), &high, count));
            });
            let stats = simulator.stats().expect("the device is not lost");
            assert_eq!(stats.leaves.falling, LEAVES, "all leaves have been falling all the time");
        }
    }
    let worlds =
        [("resting", resting(LEAVES)), ("storm", scaled("storm", LEAVES)), ("restless", restless(LEAVES))];
    for (name, scene) in worlds {
        let world = world(&scene);
        assert!(name != "resting" || world.stats().leaves.resting == LEAVES, "all leaves lie on the ground");
        for mut simulator in contenders(&world) {
            group.bench_function(BenchmarkId::new(name, simulator.info().backend), |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
        }
    }
    group.finish();
}

fn measure(criterion: &mut Criterion) {
    let mut group = group(criterion, "measure");
    group.throughput(Throughput::Elements(LEAVES.into()));
    for mut simulator in contenders(&world(&scaled("storm", LEAVES))) {
        group.bench_function(simulator.info().backend, |bencher| {
            bencher.iter(|| simulator.stats().expect("the device is not lost"));
        });
    }
    group.finish();
}

/// Calls a function with each of the inputs in turn.
fn calls<I, O>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    inputs: &[I],
    mut function: impl FnMut(&I) -> O,
) {
    assert_eq!(inputs.len(), CALLS, "as many inputs as the throughput says");
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for input in inputs {
                black_box(function(black_box(input)));
            }
        });
    });
}

fn functions(criterion: &mut Criterion) {
    let mut group = group(criterion, "function");
    group.throughput(Throughput::Elements(CALLS as u64)).sampling_mode(SamplingMode::Auto);
    // What the functions meet in a step: falling leaves of all species, in wind with two vortices.
    let World { compiled, clock, leaves, .. } = world(&scaled("storm", 1000));
    let block = compiled.step_block(&clock);
    let cx = compiled.context(&block);
    let flying = |&slot: &usize| leaves.place[slot].state() == LeafState::Falling;
    let slots: Vec<usize> = (0..leaves.len()).filter(flying).take(CALLS).collect();

    calls(&mut group, "wind_at", &slots, |&slot| wind_at(&cx, leaves.place[slot].position.into()));
    calls(&mut group, "own_orientation", &slots, |&slot| {
        own_orientation(&cx, leaves.place[slot].bits, leaves.drift[slot].phase, leaves.schedule[slot].heading)
    });
    calls(&mut group, "own_advance", &slots, |&slot| {
        let (phase, params) = (leaves.drift[slot].phase, motion_params(leaves.schedule[slot]));
        own_advance(&cx, leaves.place[slot].bits, params, phase, phase.wrapping_add(params.rate))
    });
    let mut released = Leaves::zeroed(CALLS);
    let ids: Vec<u32> = (0..).take(CALLS).collect();
    let sources = u32::try_from(compiled.scene().sources.len()).expect("a few sources");
    calls(&mut group, "leaf_release", &ids, |&id| {
        leaf_release(&cx, &mut released.as_mut().row_mut(id as usize), id, id % sources, 0);
    });
    black_box(&released);
    let seed = compiled.block().seed;
    calls(&mut group, "philox", &ids, |&id| philox(seed, [id, 16, 0, 0]));
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    advance(&mut criterion);
    measure(&mut criterion);
    functions(&mut criterion);
    criterion.final_summary();
}
