// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees on every backend, and on one thread: a step of bare ones, in a breeze and in a gale, a step with a hundred thousand leaves on them, and the
//! growing of a forest. Elements are segments, or leaves.
//!
//! `carry` is to be read beside `carry/bare`, the same trees without their leaves: the difference is the leaves'.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{WARM_UP_STEPS, YOUNG, contenders, time_steps, woods, world};
use windfall_core::scene::MeanSpeed;
use windfall_core::{Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Trees that bear the leaves of `carry`.
const BEARERS: u16 = 10;
/// Leaves of `carry` in total.
const LEAVES: u32 = 100_000;
/// Trees of the forest that is grown.
const FOREST: u16 = 100;

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group
}

/// All backends, proved, and the CPU's on one thread.
fn simulators(world: &World) -> Vec<(&'static str, Box<dyn Simulator>)> {
    let mut all: Vec<_> =
        contenders(world).into_iter().map(|simulator| (simulator.info().backend, simulator)).collect();
    all.push(("one-thread", Box::new(one_thread(world))));
    all
}

/// The CPU backend on one thread.
fn one_thread(world: &World) -> CpuSimulator {
    let one = CpuOptions { threads: Some(1), ..CpuOptions::default() };
    let mut single = CpuSimulator::new(world, one).expect("a thread can be started");
    single.step(WARM_UP_STEPS).expect("the CPU steps");
    single
}

/// Trees move, and no leaf that hangs has come off.
fn is_sound(before: &World, simulator: &mut dyn Simulator) {
    let mut after = before.clone();
    simulator.read_state(&mut after).expect("a world of the same size");
    assert_ne!(after.branches.pose, before.branches.pose, "trees sway");
    assert!(after.branches.base.iter().flatten().all(|x| x.is_finite()), "segments are somewhere");
    assert_eq!(after.stats().leaves.attached, before.stats().leaves.attached, "leaves hang as before");
}

fn sway(criterion: &mut Criterion) {
    let mut group = group(criterion, "sway");
    for trees in [10, 100, 1000] {
        let world = world(&woods(trees, YOUNG, 0));
        let segments = world.branches.len();
        let mean = segments / usize::from(trees);
        assert!((400..600).contains(&mean), "trees have {mean} segments");
        group.throughput(Throughput::Elements(segments as u64));
        for (name, mut simulator) in simulators(&world) {
            group.bench_function(BenchmarkId::new(name, trees), |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
            is_sound(&world, simulator.as_mut());
        }
    }
    group.finish();
}

/// A hundred trees on one thread in winds of two strengths; in the weaker one joints may be solved in every other step.
fn winds(criterion: &mut Criterion) {
    let mut group = group(criterion, "winds");
    for (name, speed_m_s, sway_every) in
        [("breeze", 6.5, 1), ("breeze-every-other", 6.5, 2), ("gale", 18.0, 1)]
    {
        let mut scene = woods(100, YOUNG, 0);
        scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
        scene.sway_every = sway_every;
        let world = world(&scene);
        assert_eq!(world.compiled.block().sway.interval_steps, sway_every, "{name}");
        group.throughput(Throughput::Elements(world.branches.len() as u64));
        let mut simulator = one_thread(&world);
        group.bench_function(name, |bencher| bencher.iter_custom(|count| time_steps(&mut simulator, count)));
        is_sound(&world, &mut simulator);
    }
    group.finish();
}

fn carry(criterion: &mut Criterion) {
    let mut group = group(criterion, "carry");
    group.throughput(Throughput::Elements(LEAVES.into()));
    for (kind, leaves) in [("bare", 0), ("in-leaf", LEAVES / u32::from(BEARERS))] {
        let world = world(&woods(BEARERS, 1.0, leaves));
        let attached = world.stats().leaves.attached;
        assert!(attached >= leaves * u32::from(BEARERS) / 10 * 9, "{attached} leaves hang on the trees");
        for (name, mut simulator) in simulators(&world) {
            group.bench_function(BenchmarkId::new(kind, name), |bencher| {
                bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
            });
            is_sound(&world, simulator.as_mut());
        }
    }
    group.finish();
}

fn forest(criterion: &mut Criterion) {
    let mut group = group(criterion, "forest");
    let scene = woods(FOREST, YOUNG, 100);
    let built = world(&scene);
    assert_eq!(built.state_hash(), world(&scene).state_hash(), "the same forest every time");
    group.throughput(Throughput::Elements(built.branches.len() as u64));
    group.bench_function(BenchmarkId::new("build", FOREST), |bencher| {
        bencher.iter(|| world(black_box(&scene)))
    });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    sway(&mut criterion);
    winds(&mut criterion);
    carry(&mut criterion);
    forest(&mut criterion);
    criterion.final_summary();
}
