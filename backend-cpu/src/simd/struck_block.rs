// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of particles that something is in the way of, or that few fly beside, side by side in SIMD registers: up to sixteen from here and
//! there of one population, none of them born in the step. They strike the ground alone; those that solid parts are near, and those that
//! strike four times, are left.

use bytemuck::{must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::lane::{Mask, Real, Word};
use windfall_core::arith::math::reciprocal;
use windfall_core::arith::pack::{BLOCK, Pack, ROWS_OF_LANES, load_block, rows_of_bits, store_block};
use windfall_core::arith::vector::{vec3_dot, vec3_select};
use windfall_core::blocks::PopulationBlock;
use windfall_core::device::flight::strike::{MOST_STRIKES, STRIKE_GAP_M};
use windfall_core::device::particle::fly::{ParticleFlight, particle_coasts, particle_free_step};
use windfall_core::device::particle::record::{
    MEETS_DIE, MEETS_STICK, PARTICLE_ALIVE, PARTICLE_DEAD, PARTICLE_DIED, PARTICLE_GROUNDED, PARTICLE_MARKS,
    PARTICLE_RESTING, particle_state, with_more_hits, with_particle_state,
};
use windfall_core::device::particle::step::{
    ParticleChange, is_in_reach_of_solids, is_outside, life_is_over, may_be_struck, through_sides,
};
use windfall_core::device::particle::strike::{
    PARTICLE_STILL_SQUARED, STRIKE_GROUND, bent_share, ground_gap, ground_normal, ground_strike,
    struck_velocity,
};
use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleTraits};

use super::branch_block::{Column, vector_and_fourth};
use super::leaf_block::select_four;

/// Copies of particles of one population.
#[derive(Default)]
pub(crate) struct StruckBlock {
    pub(crate) slot: [u32; BLOCK],
    pub(crate) place: [ParticlePlace; BLOCK],
    pub(crate) motion: [ParticleMotion; BLOCK],
    pub(crate) traits: [ParticleTraits; BLOCK],
    /// Accelerations by others of the population.
    pub(crate) pulls: Column,
}

/// Particles at the end of a step in which the ground was in their way.
struct GroundContact<R: Real> {
    /// Position and velocity.
    flight: ParticleFlight<R>,
    /// Number of hits.
    hits: R::Word,
    /// True for those that the ground holds.
    is_held: R::Mask,
    /// True for those that die.
    dies: R::Mask,
    /// True for those of which nothing else is known: they strike too often, or what they meet is solid.
    is_left: R::Mask,
}

impl StruckBlock {
    /// Steps the first `count` of them. Returns a bit for each that is left as it was, the first in the lowest place, and adds the events of
    /// the others to those of their population.
    #[inline(always)]
    pub(crate) fn advance<P: Pack>(
        &mut self,
        simd: P::Simd,
        cx: &Context<'_>,
        population: &PopulationBlock,
        count: usize,
        change: &mut ParticleChange,
    ) -> u32 {
        let mut sums = [0; 5];
        for part in 0..BLOCK / P::LANES {
            let found = self.advance_part::<P>(simd, cx, population, part);
            for (sum, lanes) in sums.iter_mut().zip(found) {
                *sum |= lanes << (part * P::LANES);
            }
        }
        let [left, died, ones, twos, fours] = sums.map(|lanes| rows_of_bits(lanes) & ((1 << count) - 1));
        change.died += died.count_ones();
        change.hits += ones.count_ones() + 2 * twos.count_ones() + 4 * fours.count_ones();
        left
    }

    /// Steps part of them. Bits are those of its lanes: for those that are left, for deaths, and for the digits of numbers of hits.
    #[inline(always)]
    fn advance_part<P: Pack>(
        &mut self,
        simd: P::Simd,
        cx: &Context<'_>,
        population: &PopulationBlock,
        part: usize,
    ) -> [u32; 5] {
        let place: &mut Column = must_cast_mut(&mut self.place);
        let motion: &mut Column = must_cast_mut(&mut self.motion);
        let places: [P; 4] = load_block(simd, place, part);
        let motions: [P; 4] = load_block(simd, motion, part);
        let [_, life_size, air_a, air_b]: [P; 4] = load_block(simd, must_cast_ref(&self.traits), part);
        let mutual = vector_and_fourth(load_block::<P>(simd, &self.pulls, part)).0;
        let (position, bits) = vector_and_fourth(places);
        let (velocity, birth) = vector_and_fourth(motions);
        let flags = bits.to_bits() & !PARTICLE_MARKS;
        let state = particle_state(flags);
        let rests = state.equals(PARTICLE_RESTING);
        let lives = state.equals(PARTICLE_ALIVE) | rests;
        let is_over = lives & life_is_over(cx, birth.to_bits(), life_size.to_bits());
        let moves = lives & !is_over;
        let start = ParticleFlight { position, velocity };
        let rows = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
        let slots = rows.look_up_word(&self.slot);
        let coasts = particle_coasts(cx, population, slots);
        let end = particle_free_step(cx, population, coasts, start, [air_a, air_b], mutual);
        let is_struck = moves & may_be_struck(cx, population, position, end.position);
        let contact = ground_contact(cx, population, start, end, is_struck);
        let GroundContact { flight, hits, is_held, dies, is_left } = contact;
        // What the ground holds stays where it is, but is lifted with it.
        let stays = is_held & rests;
        let pushed = ground_push(cx, vec3_select(stays, position, flight.position));
        let end = ParticleFlight {
            position: vec3_select((is_struck & !is_held) | stays, pushed, flight.position),
            velocity: vec3_select(is_held, Vec3::<f32>::ZERO.spread(air_a), flight.velocity),
        };
        let end = ParticleFlight { position: through_sides(population, end.position), ..end };
        let is_dead = is_over | (moves & (dies | is_outside(population, end.position)));
        let none = state.all(0);
        let held_flags = (flags & !PARTICLE_GROUNDED) | is_held.select(none.all(PARTICLE_GROUNDED), none);
        let mut new_flags = moves.select(held_flags, flags);
        new_flags = hits.equals(0).select(new_flags, with_more_hits(new_flags, hits));
        let alive = is_held.select(none.all(PARTICLE_RESTING), none.all(PARTICLE_ALIVE));
        let new_state = is_dead.select(none.all(PARTICLE_DEAD), moves.select(alive, state));
        new_flags = with_particle_state(new_flags, new_state) | is_dead.select(none.all(PARTICLE_DIED), none);
        let new_bits = P::from_bits(new_flags);
        let (at, to) = (end.position, end.velocity);
        let [x, y, z, _] = places;
        let moved = select_four(moves, [at.x, at.y, at.z, new_bits], [x, y, z, new_bits]);
        store_block(place, part, select_four(is_left, places, moved));
        store_block(motion, part, select_four(moves & !is_left, [to.x, to.y, to.z, birth], motions));
        let digit = |digit: u32| !is_left & !(hits & digit).equals(0);
        [is_left, is_dead & !is_left, digit(1), digit(2), digit(4)].map(
            #[inline(always)]
            |mask| P::bits_of(mask),
        )
    }
}

/// Contact of particles with the ground, as [`particle_contact`] has it with all that there is.
///
/// [`particle_contact`]: windfall_core::device::particle::strike::particle_contact
#[inline(always)]
fn ground_contact<R: Real>(
    cx: &Context<'_>,
    population: &PopulationBlock,
    start: ParticleFlight<R>,
    end: ParticleFlight<R>,
    is_struck: R::Mask,
) -> GroundContact<R> {
    let none = start.position.x.all(0.0);
    let nowhere = none.less_than(none);
    let still = Vec3::<f32>::ZERO.spread(none);
    let mut contact = GroundContact {
        flight: end,
        hits: none.to_bits().all(0),
        is_held: nowhere,
        dies: nowhere,
        is_left: nowhere,
    };
    if !is_struck.any() {
        return contact;
    }
    let mut time = none.all(cx.scene.dt_s);
    let mut from = start.position;
    let mut way = end.position - start.position;
    let mut velocity = start.velocity;
    let mut pull = (end.velocity - start.velocity) * reciprocal(time.max(none.all(1e-6)));
    let rest_m_s = 2.0 * (population.gravity_m_s2.max(0.0) * cx.scene.dt_s);
    let mut goes_on = is_struck;
    for _ in 0..MOST_STRIKES {
        if cx.scene.has_solids() {
            let is_near = is_in_reach_of_solids(cx, from, way);
            contact.is_left = contact.is_left | (goes_on & is_near);
            goes_on = goes_on & !is_near;
        }
        let strike = ground_strike(cx, from, way);
        let is_met = strike.number.equals(STRIKE_GROUND);
        let is_free = goes_on & !is_met;
        let straight = from + way * strike.share;
        contact.flight = ParticleFlight {
            position: vec3_select(is_free, straight, contact.flight.position),
            velocity: vec3_select(is_free, velocity + pull * time, contact.flight.velocity),
        };
        goes_on = goes_on & is_met;
        if !goes_on.any() {
            return contact;
        }
        if population.meets == MEETS_DIE {
            contact.flight.position = vec3_select(goes_on, straight, contact.flight.position);
            contact.hits = goes_on.select(contact.hits.all(1), contact.hits);
            contact.dies = goes_on;
            return contact;
        }
        let normal = ground_normal(cx, straight);
        let half_square = (time * 0.5) * time;
        let closing = vec3_dot(still, normal) * time - vec3_dot(way, normal);
        let bend = -(vec3_dot(pull, normal) * half_square);
        let share = bent_share(strike.share, closing, bend, vec3_dot(velocity - still, normal));
        let rest = none.all(1.0) - share;
        let place = (from + way * share) - pull * (half_square * (share * rest));
        let left = time * rest;
        let relative = (velocity + pull * (time * share)) - still;
        let is_hit = none.all(rest_m_s).less_than(-vec3_dot(relative, normal));
        let into = vec3_dot(pull, normal);
        let sliding = relative - normal * vec3_dot(relative, normal);
        let pushed = relative + (pull - normal * into) * left;
        let pressing = (-(into * left)).max(none);
        let kept = struck_velocity(
            population,
            vec3_select(is_hit, relative, pushed),
            normal,
            is_hit.select_real(none.all(population.restitution), none),
            is_hit.select_real(none, pressing),
            rest_m_s,
        );
        let is_still = vec3_dot(kept, kept).less_than(none.all(PARTICLE_STILL_SQUARED));
        contact.is_held = vec_mask(goes_on, !is_hit & is_still, contact.is_held);
        velocity = kept + still;
        pull = vec3_select(is_hit, pull, normal * into.max(none));
        let mean = vec3_select(is_hit, velocity, (sliding + kept) * none.all(0.5) + still);
        way = mean * left + pull * ((left * 0.5) * left);
        from = vec3_select(is_hit, place, place + normal * none.all(STRIKE_GAP_M));
        time = left;
        let counted = is_hit.select(contact.hits.plus(contact.hits.all(1)), contact.hits);
        contact.hits = goes_on.select(counted, contact.hits);
        if population.meets == MEETS_STICK {
            contact.hits = goes_on.select(contact.hits.all(1), contact.hits);
            contact.flight.position = vec3_select(goes_on, place, contact.flight.position);
            contact.flight.velocity = vec3_select(goes_on, still, contact.flight.velocity);
            contact.is_held = contact.is_held | goes_on;
            return contact;
        }
    }
    contact.is_left = contact.is_left | goes_on;
    contact
}

/// `yes` where true, `no` elsewhere.
#[inline(always)]
fn vec_mask<M: Mask>(mask: M, yes: M, no: M) -> M {
    (mask & yes) | (!mask & no)
}

/// Places out of the ground.
#[inline(always)]
fn ground_push<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> Vec3<R> {
    let below = ground_gap(cx, place);
    let is_below = below.less_than(below.all(0.0));
    Vec3::new(place.x, is_below.select_real(place.y - below, place.y), place.z)
}
