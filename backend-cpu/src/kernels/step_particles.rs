// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/step_particles.wgsl
//!
//! Moves particles, chunk by chunk: in blocks those that nothing is in the way of, those that rest and those not born yet; the others one by
//! one. A chunk goes through several steps while it is in the cache, as particles do not see each other; where some are born of others,
//! through one.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use rayon::join;
use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::blocks::{BirthBlock, NestBlock};
use windfall_core::device::particle::nest::{nest_events, nest_place};
use windfall_core::device::particle::record::{POPULATION_FOLLOWED, POPULATION_LOCAL, particle_population};
use windfall_core::device::particle::step::particle_step;
use windfall_core::particle::{Generation, ParticleRows, add_to_tally};

use super::CHUNK;
use crate::simd::particle_block::{ParentFrames, ParticleBlock};
use crate::simd::{Simd, in_packs};

/// Steps a generation of particles, halving the columns until a piece is one chunk, and adds to the counts of populations. `pulls` are
/// accelerations by others, slot by slot, or none.
pub(crate) fn step_particles(
    steps: &[Context<'_>],
    mut run: Generation<'_>,
    pulls: &[[f32; 4]],
    tallies: &[AtomicU32],
    simd: Simd,
) {
    if run.particles.len() > CHUNK {
        let middle = (run.particles.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = run.split_at(middle);
        join(
            || step_particles(steps, front, pulls, tallies, simd),
            || step_particles(steps, back, pulls, tallies, simd),
        );
        return;
    }
    let mut counts = vec![0; tallies.len()];
    for cx in steps {
        match simd {
            Simd::Scalar => {
                for number in 0..run.particles.len() {
                    step_one(cx, &mut run, number, pulls, &mut counts);
                }
            }
            Simd::Lanes(level) => {
                in_packs!(level, step_lanes(cx, &mut run, pulls, &mut counts));
            }
        }
    }
    for (sum, count) in tallies.iter().zip(counts) {
        if count != 0 {
            sum.fetch_add(count, Ordering::Relaxed);
        }
    }
}

/// Steps one particle of a chunk. One copy of it serves all instruction sets: it is long, and few particles need it.
#[inline(never)]
fn step_one(
    cx: &Context<'_>,
    run: &mut Generation<'_>,
    number: usize,
    pulls: &[[f32; 4]],
    counts: &mut [u32],
) {
    let population = particle_population(run.particles.place[number].bits);
    let slot = run.first + slot_word(number);
    let mutual = pulls.get(slot as usize).map_or(Vec3::ZERO, |[x, y, z, _]| Vec3::new(*x, *y, *z));
    let mut spare = bytemuck::Zeroable::zeroed();
    let begin = run.starts.get_mut(number).unwrap_or(&mut spare);
    let change = particle_step(cx, &mut run.particles.row_mut(number), &run.parents, slot, mutual, begin);
    add_to_tally(counts, population, &change);
}

/// Steps a chunk block by block; blocks with births, and those of several populations, one particle after another.
#[inline(always)]
fn step_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    run: &mut Generation<'_>,
    pulls: &[[f32; 4]],
    counts: &mut [u32],
) {
    let (count, first) = (run.particles.len(), run.first as usize);
    for begin in (0..count).step_by(BLOCK) {
        let rows = begin..count.min(begin + BLOCK);
        let [here, last] =
            [rows.start, rows.end - 1].map(|row| particle_population(run.particles.place[row].bits));
        let population = &cx.scene.populations[here as usize];
        let place = first + begin - population.first_slot as usize;
        let births = &cx.step.births[here as usize];
        let mut left = (1u32 << rows.len()) - 1;
        let is_born_into = || match population.nest.fan {
            0 => births_touch(births, population.count as usize, place),
            _ => parents_bear(cx, &population.nest, &run.parents, place..place + BLOCK),
        };
        if here == last && rows.len() == BLOCK && !is_born_into() {
            let whole = "a whole block";
            let mut block = ParticleBlock {
                slot: slot_word(first + begin),
                place: (&mut run.particles.place[rows.clone()]).try_into().expect(whole),
                motion: (&mut run.particles.motion[rows.clone()]).try_into().expect(whole),
                traits: (&run.particles.traits[rows.clone()]).try_into().expect(whole),
                pulls: pulls
                    .get(first + begin..first + begin + BLOCK)
                    .map(|rows| rows.try_into().expect(whole)),
            };
            if (population.flags & POPULATION_FOLLOWED) != 0 {
                block.begin(&mut run.starts[rows.clone()]);
            }
            let frames = ((population.flags & POPULATION_LOCAL) != 0)
                .then(|| ParentFrames::of(cx, population, &run.parents, &block));
            left = block.advance::<P>(simd, cx, here as usize, frames.as_ref());
        }
        while left != 0 {
            step_one(cx, run, begin + left.trailing_zeros() as usize, pulls, counts);
            left &= left - 1;
        }
    }
}

/// Returns true if births by parents fall on a run of slots in a step, from a place of their population on.
#[inline(always)]
fn parents_bear(
    cx: &Context<'_>,
    nest: &NestBlock,
    parents: &ParticleRows<'_>,
    mut places: Range<usize>,
) -> bool {
    places.any(|place| {
        let share = nest_place(nest, slot_word(place));
        let parent = (nest.parent_slot + share.parent) as usize;
        let (bits, birth) = (parents.place[parent].bits, parents.motion[parent].birth);
        nest_events(cx, nest, bits, birth, parents.traits[parent].id, share.round).count != 0
    })
}

/// A slot as devices count it.
#[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
fn slot_word(slot: usize) -> u32 {
    slot as u32
}

/// Returns true if births of a step may fall on the block that begins at a place among the slots of a population.
#[inline(always)]
fn births_touch(births: &BirthBlock, count: usize, place: usize) -> bool {
    let after = (place + count - births.first_place as usize) % count;
    births.count != 0 && (after < births.count as usize || after + BLOCK > count)
}
