// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves with all their maps on one thread, by edge in pixels; elements are pixels, so that a rate that stays the same
//! says that the work is linear. `examples` is what is done once for a kind of leaf.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_texgen::{LeafMaker, MakeOptions, Shape};

/// Edges of the leaves in pixels.
const SIZES: [u32; 3] = [256, 512, 1024];

fn leaves(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("leaf");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(4));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for size_px in SIZES {
        let options = MakeOptions { size_px, season: None, seed: 1 };
        let maker = LeafMaker::of_shape(Shape::Hornbeam, options).expect("allowed options");
        let leaf = maker.make(0, false).expect("a leaf");
        let covered = leaf.maps.albedo.pixels().filter(|pixel| pixel[3] > 127).count() as f32;
        let share = covered / (size_px * size_px) as f32;
        assert!((0.1..0.8).contains(&share), "a leaf covers a part of its picture, not {share}");
        group.throughput(Throughput::Elements(u64::from(size_px) * u64::from(size_px)));
        group.bench_function(BenchmarkId::new("make", size_px), |bencher| {
            bencher.iter(|| maker.make(black_box(0), false).expect("a leaf"));
        });
        group.bench_function(BenchmarkId::new("examples", size_px), |bencher| {
            bencher
                .iter(|| LeafMaker::of_shape(Shape::Hornbeam, black_box(options)).expect("allowed options"));
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    leaves(&mut criterion);
    criterion.final_summary();
}
