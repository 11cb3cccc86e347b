// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/pull_particles.wgsl
//!
//! Sums the attractions of the particles of a population by one another: a block of targets side by side, source after source.

use rayon::prelude::*;
use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::pack::{BLOCK, Pack, load_block, store_block};
use windfall_core::blocks::PopulationBlock;
use windfall_core::device::particle::mutual::{mutual_pull, mutual_source};
use windfall_core::device::particle::record::POPULATION_MUTUAL;
use windfall_core::particle::ParticleStore;

use crate::simd::{Simd, in_packs};

/// Targets whose sums a thread forms at a time.
const TARGETS: usize = 8 * BLOCK;

/// Fills the accelerations of all particles that attract one another, slot by slot; others stay as they are.
pub(crate) fn pull_particles(
    cx: &Context<'_>,
    particles: &ParticleStore,
    pulls: &mut [[f32; 4]],
    simd: Simd,
) {
    for population in cx.scene.populations.iter().filter(|block| (block.flags & POPULATION_MUTUAL) != 0) {
        let slots = population.first_slot as usize..(population.first_slot + population.count) as usize;
        let rows = particles.place[slots.clone()].iter().zip(&particles.motion[slots.clone()]);
        let sources: Vec<_> =
            rows.map(|(place, motion)| mutual_source(cx, population, place, motion)).collect();
        let targets = pulls[slots].par_chunks_mut(TARGETS).zip(sources.par_chunks(TARGETS));
        targets.for_each(|(pulls, middles)| match simd {
            Simd::Scalar => pull_each(population, &sources, middles, pulls),
            Simd::Lanes(level) => in_packs!(level, pull_lanes(population, &sources, middles, pulls)),
        });
    }
}

/// Forms the sums one target after another.
fn pull_each(
    population: &PopulationBlock,
    sources: &[[f32; 4]],
    middles: &[[f32; 4]],
    pulls: &mut [[f32; 4]],
) {
    for ([x, y, z, _], pull) in middles.iter().zip(pulls) {
        let middle = Vec3::new(*x, *y, *z);
        let sum =
            sources.iter().fold(Vec3::ZERO, |sum, source| mutual_pull(population, sum, middle, *source));
        *pull = [sum.x, sum.y, sum.z, 0.0];
    }
}

/// Forms the sums block by block, the last few one after another.
#[inline(always)]
fn pull_lanes<P: Pack>(
    simd: P::Simd,
    population: &PopulationBlock,
    sources: &[[f32; 4]],
    middles: &[[f32; 4]],
    pulls: &mut [[f32; 4]],
) {
    let (blocks, rest) = middles.as_chunks::<BLOCK>();
    let (pull_blocks, pull_rest) = pulls.as_chunks_mut::<BLOCK>();
    for (block, pulls) in blocks.iter().zip(pull_blocks) {
        for part in 0..BLOCK / P::LANES {
            let [x, y, z, none]: [P; 4] = load_block(simd, block, part);
            let middle = Vec3::new(x, y, z);
            let zero = none.all(0.0);
            let mut sum = Vec3::new(zero, zero, zero);
            for source in sources {
                sum = mutual_pull(population, sum, middle, *source);
            }
            store_block(pulls, part, [sum.x, sum.y, sum.z, zero]);
        }
    }
    pull_each(population, sources, rest, pull_rest);
}
