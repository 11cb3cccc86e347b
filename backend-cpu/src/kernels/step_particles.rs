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
use windfall_core::blocks::{BirthBlock, NEVER, NestBlock};
use windfall_core::device::particle::nest::{nest_events, nest_place};
use windfall_core::device::particle::record::{
    PARTICLE_DEAD, PARTICLE_DORMANT, PARTICLE_MARKS, PARTICLE_STATE_MASK, POPULATION_BRANCH_SNOW,
    POPULATION_FOLLOWED, POPULATION_LOCAL, POPULATION_ON_LEAVES, POPULATION_SNOW, particle_population,
};
use windfall_core::device::particle::step::{ParticleChange, particle_step};
use windfall_core::device::tree::branch_fall::fall_row;
use windfall_core::litter::has_landed;
use windfall_core::particle::{Generation, ParticlePlace, ParticleRows, add_to_tally};

use super::CHUNK;
use super::fly::{FewOfBlocks, slots_of};
use super::land_flakes::Landings;
use crate::quiet::places_of;
use crate::simd::particle_block::{ParentFrames, ParticleBlock};
use crate::simd::struck_block::StruckBlock;
use crate::simd::{Simd, in_packs};

/// Particles up to which registers are not worth filling.
const FEW: usize = 2;

/// Steps a generation of particles, halving the columns until a piece is one chunk, and adds to the counts of populations. `pulls` are
/// accelerations by others, slot by slot, or none. Flakes that land are noted, step by step.
pub(crate) fn step_particles(
    steps: &[Context<'_>],
    mut run: Generation<'_>,
    pulls: &[[f32; 4]],
    tallies: &[AtomicU32],
    landings: &[Landings],
    simd: Simd,
) {
    if run.particles.len() > CHUNK {
        let middle = (run.particles.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = run.split_at(middle);
        join(
            || step_particles(steps, front, pulls, tallies, landings, simd),
            || step_particles(steps, back, pulls, tallies, landings, simd),
        );
        return;
    }
    let mut events = ChunkEvents { counts: vec![0; tallies.len()], landed: Vec::new() };
    for (cx, landings) in steps.iter().zip(landings) {
        match simd {
            Simd::Scalar => {
                for number in 0..run.particles.len() {
                    step_one(cx, &mut run, number, pulls, &mut events);
                }
            }
            Simd::Lanes(level) => {
                in_packs!(level, step_lanes(cx, &mut run, pulls, &mut events));
            }
        }
        landings.append(&mut events.landed);
    }
    for (sum, count) in tallies.iter().zip(events.counts) {
        if count != 0 {
            sum.fetch_add(count, Ordering::Relaxed);
        }
    }
}

/// Events of a chunk.
struct ChunkEvents {
    /// Counts of populations in the steps so far.
    counts: Vec<u32>,
    /// Places of flakes that landed in a step.
    landed: Vec<[f32; 3]>,
}

impl ChunkEvents {
    /// Adds what has happened to particles of a population, the last of them here.
    fn add(&mut self, cx: &Context<'_>, population: u32, change: &ParticleChange, places: &[ParticlePlace]) {
        add_to_tally(&mut self.counts, population, change);
        if change.died != 0 && (cx.scene.populations[population as usize].flags & POPULATION_SNOW) != 0 {
            self.landed.extend(places.iter().filter(|place| has_landed(place)).map(|place| place.position));
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
    events: &mut ChunkEvents,
) {
    let population = particle_population(run.particles.place[number].bits);
    let slot = run.first + slot_word(number);
    let mutual = pulls.get(slot as usize).map_or(Vec3::ZERO, |[x, y, z, _]| Vec3::new(*x, *y, *z));
    let mut spare = bytemuck::Zeroable::zeroed();
    let begin = run.starts.get_mut(number).unwrap_or(&mut spare);
    let change = particle_step(cx, &mut run.particles.row_mut(number), &run.parents, slot, mutual, begin);
    events.add(cx, population, &change, &run.particles.place[number..=number]);
}

/// Steps a chunk block by block; blocks with births, and those of several populations, one particle after another. What something is in
/// the way of, dies, or flies with few beside it comes last, side by side with others from all over the chunk.
#[inline(always)]
fn step_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    run: &mut Generation<'_>,
    pulls: &[[f32; 4]],
    events: &mut ChunkEvents,
) {
    let (count, first) = (run.particles.len(), run.first as usize);
    let mut struck: FewOfBlocks = [0; CHUNK / BLOCK];
    for (begin, struck) in (0..count).step_by(BLOCK).zip(&mut struck) {
        let rows = begin..count.min(begin + BLOCK);
        let [here, last] =
            [rows.start, rows.end - 1].map(|row| particle_population(run.particles.place[row].bits));
        let population = &cx.scene.populations[here as usize];
        let place = first + begin - population.first_slot as usize;
        let births = &cx.step.births[here as usize];
        let is_born_into = || match population.nest.fan {
            0 => births_touch(births, population.count as usize, place),
            _ => parents_bear(cx, &population.nest, &run.parents, place..place + BLOCK),
        };
        if (population.flags & POPULATION_ON_LEAVES) != 0 && here == last {
            for row in rows {
                // Most leaves do not burn.
                if (run.particles.place[row].bits & (PARTICLE_STATE_MASK | PARTICLE_MARKS))
                    != PARTICLE_DORMANT
                {
                    step_one(cx, run, row, pulls, events);
                }
            }
            continue;
        }
        if (population.flags & POPULATION_BRANCH_SNOW) != 0 && here == last {
            for (number, row) in rows.enumerate() {
                let state = run.particles.place[row].bits & (PARTICLE_STATE_MASK | PARTICLE_MARKS);
                // Most of them wait for snow to fall.
                let idles = state == PARTICLE_DORMANT || state == PARTICLE_DEAD;
                if !idles || fall_row(cx, slot_word(place + number)) != NEVER {
                    step_one(cx, run, row, pulls, events);
                }
            }
            continue;
        }
        if here != last || rows.len() != BLOCK || is_born_into() {
            rows.for_each(|row| step_one(cx, run, row, pulls, events));
            continue;
        }
        let whole = "a whole block";
        let mut block = ParticleBlock {
            slot: slot_word(first + begin),
            place: (&mut run.particles.place[rows.clone()]).try_into().expect(whole),
            motion: (&mut run.particles.motion[rows.clone()]).try_into().expect(whole),
            traits: (&run.particles.traits[rows.clone()]).try_into().expect(whole),
            pulls: pulls.get(first + begin..first + begin + BLOCK).map(|rows| rows.try_into().expect(whole)),
        };
        if (population.flags & POPULATION_FOLLOWED) != 0 {
            block.begin(&mut run.starts[rows.clone()]);
        }
        let frames = ((population.flags & POPULATION_LOCAL) != 0)
            .then(|| ParentFrames::of(cx, population, &run.parents, &block));
        *struck = block.advance::<P>(simd, cx, here as usize, frames.as_ref());
    }
    let mut block = StruckBlock::default();
    let mut rows = slots_of(struck);
    let mut next = rows.next();
    while let Some(row) = next {
        let mut together = [row; BLOCK];
        let mut count = 0;
        let population = particle_population(run.particles.place[row].bits);
        while let Some(row) = next
            && count < BLOCK
            && particle_population(run.particles.place[row].bits) == population
        {
            together[count] = row;
            count += 1;
            next = rows.next();
        }
        let together = &together[..count];
        let mut left = (1 << count) - 1;
        let flags = cx.scene.populations[population as usize].flags;
        // What goes along with a parent meets the ground on its parent's way.
        if count > FEW && (flags & POPULATION_LOCAL) == 0 {
            left = step_struck::<P>(simd, cx, run, together, pulls, &mut block, events);
        }
        places_of(left).for_each(|at| step_one(cx, run, together[at], pulls, events));
    }
}

/// Steps particles of a population, from here and there in a chunk and none of them born, side by side. Returns a bit for each that needs
/// a step of its own.
#[inline(always)]
fn step_struck<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    run: &mut Generation<'_>,
    rows: &[usize],
    pulls: &[[f32; 4]],
    block: &mut StruckBlock,
    events: &mut ChunkEvents,
) -> u64 {
    let (first, particles) = (run.first as usize, &mut run.particles);
    for (at, &row) in rows.iter().enumerate() {
        block.slot[at] = slot_word(first + row);
        block.place[at] = particles.place[row];
        block.motion[at] = particles.motion[row];
        block.traits[at] = particles.traits[row];
        block.pulls[at] = pulls.get(first + row).copied().unwrap_or_default();
    }
    let population = particle_population(particles.place[rows[0]].bits);
    let mut change = ParticleChange::default();
    let left =
        block.advance::<P>(simd, cx, &cx.scene.populations[population as usize], rows.len(), &mut change);
    events.add(cx, population, &change, &block.place[..rows.len()]);
    for (at, &row) in rows.iter().enumerate() {
        particles.place[row] = block.place[at];
        particles.motion[row] = block.motion[at];
    }
    left.into()
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
