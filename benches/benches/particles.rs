// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A million sparks on every backend, with nothing in their way, over a lawn, and with four forces, beside two measures of what could be:
//! their columns read and written with nothing done in between, and the same flights in a plain loop over an array of structs, in which
//! nothing is born or comes to rest. Then bodies that attract one another. Elements are particle-steps.

use std::hint::black_box;
use std::thread::{available_parallelism, scope};
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use windfall_benches::{
    attracting, contenders, driven_sparks, free_sparks, sized, sparks, time_steps, world,
};
use windfall_core::arith::Vec3;
use windfall_core::device::particle::fly::{ParticleFlight, particle_fly};
use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleTraits};
use windfall_core::{Context, World};

/// Particles.
const SPARKS: u32 = 1_000_000;
/// Bodies that attract one another.
const BODIES: u32 = 4096;

/// A particle in one record, as a plain program keeps it.
#[derive(Clone, Copy)]
struct Spark {
    place: ParticlePlace,
    motion: ParticleMotion,
    traits: ParticleTraits,
}

/// One step of a spark: weight, drag, a bounce off level ground, and nothing for those that are dead.
fn step_spark(cx: &Context<'_>, spark: &mut Spark) {
    if cx.step.index.wrapping_sub(spark.motion.birth) >= spark.traits.life_size & 0xffff {
        return;
    }
    let start =
        ParticleFlight { position: spark.place.position.into(), velocity: spark.motion.velocity.into() };
    let mut end = particle_fly(cx, &cx.scene.populations[0], start, spark.traits.air, Vec3::ZERO);
    if end.position.y < 0.0 {
        let Vec3 { x, y, z } = end.velocity;
        end.position.y = -end.position.y;
        end.velocity = Vec3::new(0.9 * x, -0.5 * y, 0.9 * z);
    }
    spark.place.position = end.position.to_array();
    spark.motion.velocity = end.velocity.to_array();
}

/// Does the same to each of as many pieces as there are threads.
fn in_pieces<T: Send>(rows: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    let threads = available_parallelism().map_or(1, usize::from);
    let length = rows.len().div_ceil(threads);
    scope(|scope| {
        for (number, piece) in rows.chunks_mut(length).enumerate() {
            let work = &work;
            scope.spawn(move || work(number * length, piece));
        }
    });
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// Times a world on every backend.
fn on_backends(group: &mut Group<'_>, name: &str, world: &World) {
    for mut simulator in contenders(world) {
        group.bench_function(BenchmarkId::new(name, simulator.info().backend), |bencher| {
            bencher.iter_custom(|count| time_steps(simulator.as_mut(), count));
        });
    }
}

/// Times a world as an array of structs.
fn as_structs(group: &mut Group<'_>, name: &str, world: World) {
    let World { compiled, clock, particles, .. } = world;
    let block = compiled.step_block(&clock);
    let cx = compiled.context(&block);
    let mut sparks: Vec<Spark> = (particles.place.iter().zip(&particles.motion).zip(&particles.traits))
        .map(|((&place, &motion), &traits)| Spark { place, motion, traits })
        .collect();
    group.bench_function(BenchmarkId::new(name, "array_of_structs"), |bencher| {
        bencher.iter(|| {
            in_pieces(&mut sparks, |_, piece| piece.iter_mut().for_each(|spark| step_spark(&cx, spark)))
        });
    });
    black_box(&sparks);
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("particles");
    group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(SPARKS.into()));
    on_backends(&mut group, "free", &world(&free_sparks(sized(SPARKS))));
    for (name, scene) in [("sparks", sparks(sized(SPARKS))), ("driven", driven_sparks(sized(SPARKS)))] {
        let world = world(&scene);
        on_backends(&mut group, name, &world);
        as_structs(&mut group, name, world);
    }
    let mut hot: Vec<[[f32; 4]; 2]> = vec![[[1.0; 4]; 2]; SPARKS as usize];
    let read: Vec<[f32; 4]> = vec![[1.0; 4]; SPARKS as usize];
    group.bench_function("memory_floor", |bencher| {
        bencher.iter_custom(|count| {
            let begin = Instant::now();
            for _ in 0..count {
                in_pieces(&mut hot, |first, piece| {
                    for (row, other) in piece.iter_mut().zip(&read[first..]) {
                        for part in 0..4 {
                            row[0][part] += other[part];
                            row[1][part] += other[part];
                        }
                    }
                });
            }
            begin.elapsed()
        });
    });
    black_box(&hot);
    group.throughput(Throughput::Elements(BODIES.into()));
    on_backends(&mut group, "mutual", &world(&attracting(BODIES)));
    group.finish();
    criterion.final_summary();
}
