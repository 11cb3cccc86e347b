// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of sixteen particles of one population, side by side in SIMD registers.

use bytemuck::{must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::lane::{Mask, Real, Word};
use windfall_core::arith::pack::{BLOCK, Pack, ROWS_OF_LANES, load_block, rows_of_bits, store_block};
use windfall_core::arith::vector::vec3_select;
use windfall_core::blocks::PopulationBlock;
use windfall_core::device::particle::fly::{ParticleFlight, particle_coasts, particle_free_step};
use windfall_core::device::particle::local_space::{ParticleFrame, carried_flight, in_frame};
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_GROUNDED, PARTICLE_MARKS, PARTICLE_RESTING, particle_state,
};
use windfall_core::device::particle::step::{
    is_outside, is_unborn, life_is_over, may_be_struck, rest_wakes, slot_frame,
};
use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleRows, ParticleStart, ParticleTraits};

use super::branch_block::{Column, vector_and_fourth};
use super::leaf_block::select_four;

/// Height in m above everything solid.
const HIGH_ABOVE_M: f32 = 1e6;
/// Quarters of the lanes that fly from which on they are stepped where they are; fewer are gathered from all over a chunk.
const DENSE_QUARTERS: usize = 3;
/// Most standard deviations that a normal draw is off its mean: the sum of four 16-bit numbers ends at the root of 12.
const MOST_DEVIATIONS: f32 = 3.5;

/// Slots of one population that follow one another, none of them born in the step.
pub(crate) struct ParticleBlock<'a> {
    /// Slot of the first of them.
    pub(crate) slot: u32,
    pub(crate) place: &'a mut [ParticlePlace; BLOCK],
    pub(crate) motion: &'a mut [ParticleMotion; BLOCK],
    pub(crate) traits: &'a [ParticleTraits; BLOCK],
    /// Accelerations by others of the population; `None` where particles do not attract one another.
    pub(crate) pulls: Option<&'a Column>,
}

/// Steps that every particle of a population lives at least, as births draw them.
#[inline(always)]
fn least_life(population: &PopulationBlock) -> u32 {
    let life = population.life_steps;
    if life.mean <= 0.0 {
        return u32::MAX;
    }
    let narrowest = (life.mean - life.half_width) - MOST_DEVIATIONS * life.deviation;
    (narrowest + life.cubic_width.min(0.0) - 1.0).max(0.0).to_whole()
}

/// Frames of the parents that the particles of a block go along with.
pub(crate) struct ParentFrames {
    start: Column,
    start_velocity: Column,
    end: Column,
    end_velocity: Column,
}

impl ParentFrames {
    /// Frames for a block none of whose particles is born in the step.
    pub(crate) fn of(
        cx: &Context<'_>,
        population: &PopulationBlock,
        parents: &ParticleRows<'_>,
        block: &ParticleBlock<'_>,
    ) -> Self {
        let mut frames = Self {
            start: [[0.0; 4]; BLOCK],
            start_velocity: [[0.0; 4]; BLOCK],
            end: [[0.0; 4]; BLOCK],
            end_velocity: [[0.0; 4]; BLOCK],
        };
        for (row, slot) in (block.slot..).take(BLOCK).enumerate() {
            let frame = slot_frame(cx, population, parents, slot, block.motion[row].birth, cx.scene.dt_s);
            let four = |Vec3 { x, y, z }: Vec3| [x, y, z, 0.0];
            frames.start[row] = four(frame.start.position);
            frames.start_velocity[row] = four(frame.start.velocity);
            frames.end[row] = four(frame.end.position);
            frames.end_velocity[row] = four(frame.end.velocity);
        }
        frames
    }

    /// Part of the frames, side by side.
    #[inline(always)]
    fn part<P: Pack>(&self, simd: P::Simd, part: usize) -> ParticleFrame<P> {
        let vector = |column| vector_and_fourth(load_block::<P>(simd, column, part)).0;
        ParticleFrame {
            start: ParticleFlight { position: vector(&self.start), velocity: vector(&self.start_velocity) },
            end: ParticleFlight { position: vector(&self.end), velocity: vector(&self.end_velocity) },
        }
    }
}

impl ParticleBlock<'_> {
    /// Notes where the particles start the step.
    pub(crate) fn begin(&self, starts: &mut [ParticleStart]) {
        for (start, (place, motion)) in starts.iter_mut().zip(self.place.iter().zip(&*self.motion)) {
            (start.position, start.velocity) = (place.position, motion.velocity);
        }
    }

    /// Steps those that fly with nothing in their way, rest or wait to be born. Returns a bit for each that is left, the first in the lowest
    /// place: what it meets or its death needs a step of its own, or few beside it fly. `frames` are those of parents that they go along with.
    #[inline(always)]
    pub(crate) fn advance<P: Pack>(
        &mut self,
        simd: P::Simd,
        cx: &Context<'_>,
        population: usize,
        frames: Option<&ParentFrames>,
    ) -> u32 {
        let (mut left, mut resting) = (0, 0);
        for part in 0..BLOCK / P::LANES {
            let [others, lying] = self.advance_part::<P>(simd, cx, population, frames, part);
            left |= others << (part * P::LANES);
            resting |= lying << (part * P::LANES);
        }
        let (mut left, mut resting) = (rows_of_bits(left), rows_of_bits(resting));
        while resting != 0 {
            let row = resting.trailing_zeros();
            if rest_wakes(cx, &cx.scene.populations[population], self.traits[row as usize].id) {
                left |= 1 << row;
            }
            resting &= resting - 1;
        }
        left
    }

    /// Steps part of them. Bits are those of its lanes: a step of its own for those of the first word, and for those of the second, which
    /// rest, only if they are looked at.
    #[inline(always)]
    fn advance_part<P: Pack>(
        &mut self,
        simd: P::Simd,
        cx: &Context<'_>,
        population: usize,
        frames: Option<&ParentFrames>,
        part: usize,
    ) -> [u32; 2] {
        let population = &cx.scene.populations[population];
        let place: &mut Column = must_cast_mut(self.place);
        let motion: &mut Column = must_cast_mut(self.motion);
        let places: [P; 4] = load_block(simd, place, part);
        let motions: [P; 4] = load_block(simd, motion, part);
        let (position, bits) = vector_and_fourth(places);
        let (velocity, birth) = vector_and_fourth(motions);
        let flags = bits.to_bits();
        let state = particle_state(flags);
        let unmarked = flags & !PARTICLE_MARKS;
        let rows = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
        let coasts = particle_coasts(cx, population, rows.plus(rows.all(self.slot)));
        let all_coast = !(!coasts).any();
        let is_alive = state.equals(PARTICLE_ALIVE);
        let age = state.all(cx.step.index).minus(birth.to_bits());
        let mut is_over = age.less_than(state.all(0));
        let mut air = [birth.all(0.0); 2];
        // What goes straight on and cannot be too old moves without its traits: a fifth fewer bytes.
        if !all_coast || (is_alive & !age.less_than(state.all(least_life(population)))).any() {
            let [_, life_size, air_a, air_b]: [P; 4] = load_block(simd, must_cast_ref(self.traits), part);
            is_over = life_is_over(cx, birth.to_bits(), life_size.to_bits());
            air = [air_a, air_b];
        }
        let is_idle = is_unborn(flags);
        let rests = state.equals(PARTICLE_RESTING) & !is_over;
        let flies = is_alive & !is_over;
        let count = P::bits_of(flies).count_ones() as usize;
        let are_few = 4 * count < DENSE_QUARTERS * P::LANES && !all_coast && frames.is_none();
        if count == 0 || are_few {
            if (!(flags & PARTICLE_MARKS).equals(0)).any() {
                let [x, y, z, _] = places;
                store_block(place, part, [x, y, z, P::from_bits(unmarked)]);
            }
            return [P::bits_of(!(is_idle | rests)), P::bits_of(rests)];
        }
        let mutual = match self.pulls {
            Some(pulls) => vector_and_fourth(load_block::<P>(simd, pulls, part)).0,
            None => Vec3::<f32>::ZERO.spread(birth),
        };
        let start = ParticleFlight { position, velocity };
        let frame = frames.map(|frames| frames.part::<P>(simd, part));
        let inside = match frame {
            Some(frame) => in_frame(frame, start),
            None => start,
        };
        // Called in one place, as the flight of bodies is: this is the longest code of all.
        let mut end = particle_free_step(cx, population, coasts, inside, air, mutual);
        if let Some(frame) = frame {
            end = carried_flight(frame, end);
        }
        // What does not fly is asked for high above all things, so that it makes none of the others wait.
        let above = Vec3::new(0.0, HIGH_ABOVE_M, 0.0).spread(birth);
        let [from, to] = [position, end.position].map(
            #[inline(always)]
            |place| vec3_select(flies, place, above),
        );
        let ends = may_be_struck(cx, population, from, to) | is_outside(population, end.position);
        let moved = flies & !ends;
        // Nothing holds what flies. Those that are left lose their marks here as they would there.
        let new_bits = P::from_bits(moved.select(unmarked & !PARTICLE_GROUNDED, unmarked));
        let mut new_places = [end.position.x, end.position.y, end.position.z, new_bits];
        let mut new_motions = [end.velocity.x, end.velocity.y, end.velocity.z, birth];
        if (!moved).any() {
            let [x, y, z, _] = places;
            new_places = select_four(moved, new_places, [x, y, z, new_bits]);
            new_motions = select_four(moved, new_motions, motions);
        }
        store_block(place, part, new_places);
        if !all_coast {
            store_block(motion, part, new_motions);
        }
        [P::bits_of(!(moved | is_idle | rests)), P::bits_of(rests)]
    }
}
