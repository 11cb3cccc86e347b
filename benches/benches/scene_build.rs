// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a scene's text to a world, part by part, and checkpoints there and back.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput};
use windfall_benches::{scaled, world};
use windfall_core::wind::turbulence_box;
use windfall_core::{CompiledScene, Scene, World};

/// Leaves of the larger world.
const LEAVES: u32 = 100_000;
const PARK: &str = "autumn-park";

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group
}

fn scene(criterion: &mut Criterion) {
    let mut group = group(criterion, "scene");
    group.bench_function("preset/autumn-park", |bencher| bencher.iter(|| Scene::preset(black_box(PARK))));
    group.finish();
}

fn compiled(criterion: &mut Criterion) {
    let mut group = group(criterion, "compiled");
    let park = Scene::preset(PARK).expect("a preset");
    group.bench_function("compile/autumn-park", |bencher| {
        bencher.iter(|| CompiledScene::compile(black_box(&park)).expect("a valid scene"));
    });
    group.bench_function("turbulence_box", |bencher| bencher.iter(|| turbulence_box(black_box([20, 0]), 64)));
    group.finish();
}

fn build(criterion: &mut Criterion) {
    let mut group = group(criterion, "world");
    for (name, scene) in [
        ("build/autumn-park", Scene::preset(PARK).expect("a preset")),
        ("build/million", scaled("million", LEAVES)),
    ] {
        let built = world(&scene);
        assert_eq!(built.leaves.len(), scene.leaf_count() as usize, "{name}: all leaves");
        assert_eq!(built.state_hash(), world(&scene).state_hash(), "{name}: the same world every time");
        group.throughput(Throughput::Elements(scene.leaf_count().into()));
        group.bench_function(name, |bencher| bencher.iter(|| world(black_box(&scene))));
    }
    group.finish();
}

fn checkpoint(criterion: &mut Criterion) {
    let mut group = group(criterion, "checkpoint");
    let world = world(&scaled("million", LEAVES));
    let mut bytes = Vec::new();
    let write = |bytes: &mut Vec<u8>| {
        bytes.clear();
        world.write_checkpoint(bytes).expect("memory takes all bytes");
    };
    let read = |bytes: &[u8]| World::from_checkpoint(bytes, "bench").expect("just written");
    write(&mut bytes);
    assert_eq!(read(&bytes).state_hash(), world.state_hash(), "there and back to the bit");

    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.bench_function("read/million", |bencher| bencher.iter(|| read(black_box(&bytes))));
    group.bench_function("write/million", |bencher| bencher.iter(|| write(black_box(&mut bytes))));
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    scene(&mut criterion);
    compiled(&mut criterion);
    build(&mut criterion);
    checkpoint(&mut criterion);
    criterion.final_summary();
}
