// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/step.wgsl
//!
//! One step of one particle, in the order of deaths, births, forces, hits, places.

use super::birth::{birth_number, particle_birth};
use super::fly::{ParticleFlight, particle_coasts, particle_free_step};
use super::local_space::{ParticleFrame, carried_flight, in_frame, parent_frame, rest_frame};
use super::nest::{nest_events, nest_id, nest_place, nest_rest, nest_start};
use super::record::{
    MEETS_NOTHING, MEETS_STICK, PARTICLE_ALIVE, PARTICLE_DEAD, PARTICLE_DIED, PARTICLE_DORMANT,
    PARTICLE_GROUNDED, PARTICLE_MARKS, PARTICLE_RESTING, POPULATION_BRANCH_SNOW, POPULATION_LOCAL,
    POPULATION_ON_LEAVES, POPULATION_THROUGH, ParticleStart, particle_life, particle_population,
    particle_state, with_more_hits, with_particle_state,
};
use super::strike::{STRIKE_GROUND, particle_contact, particle_push};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::{NEVER, PopulationBlock};
use crate::context::Context;
use crate::device::solid::near::may_meet_solids_on_way;
use crate::device::terrain::ground::ground_met;
use crate::device::tree::branch_fall::{fall_row, fall_start};
use crate::particle::{ParticleMut, ParticleRows};

/// Events of a particle in a step, to be added to the counts of its population.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ParticleChange {
    /// Births; more than one where several events of a parent in one step fall on a slot.
    pub born: u32,
    /// Deaths.
    pub died: u32,
    /// Hits.
    pub hits: u32,
    /// 1 if its fourth hit stopped it.
    pub stopped: u32,
    /// Lives that were not over, or just so, when their slot was needed: they have no death.
    pub cut_short: u32,
}

/// Returns true for particles whose age ends their life in a step.
#[inline(always)]
pub fn life_is_over<W: Word>(cx: &Context<'_>, birth: W, life_size: W) -> W::Mask {
    let life = particle_life(life_size);
    let age = birth.all(cx.step.index).minus(birth);
    !(life.equals(0) | age.less_than(life))
}

/// Returns true for particles outside the region in which they live.
#[inline(always)]
pub fn is_outside<R: Real>(population: &PopulationBlock, place: Vec3<R>) -> R::Mask {
    let low = Vec3::from(population.low_m).spread(place.x);
    let high = Vec3::from(population.high_m).spread(place.x);
    place.x.less_than(low.x)
        | place.y.less_than(low.y)
        | place.z.less_than(low.z)
        | high.x.less_than(place.x)
        | high.y.less_than(place.y)
        | high.z.less_than(place.z)
}

/// Place of a particle that has gone through a side of its region, in populations that come in again through the opposite one.
#[inline(always)]
pub fn through_sides<R: Real>(population: &PopulationBlock, place: Vec3<R>) -> Vec3<R> {
    if (population.flags & POPULATION_THROUGH) == 0 {
        return place;
    }
    let again = |at: R, low_m: f32, high_m: f32| {
        let (none, width) = (at.all(0.0), at.all(high_m - low_m));
        let below = at.less_than(at.all(low_m)).select_real(width, none);
        let above = at.all(high_m).less_than(at).select_real(width, none);
        (at + below) - above
    };
    Vec3::new(
        again(place.x, population.low_m[0], population.high_m[0]),
        place.y,
        again(place.z, population.low_m[2], population.high_m[2]),
    )
}

/// Returns true for particles that something may be in the way of.
#[inline(always)]
pub fn may_be_struck<R: Real>(
    cx: &Context<'_>,
    population: &PopulationBlock,
    start: Vec3<R>,
    end: Vec3<R>,
) -> R::Mask {
    if population.meets == MEETS_NOTHING {
        return start.x.less_than(start.x);
    }
    let meets_ground = ground_met(cx, end);
    if !cx.scene.has_solids() {
        return meets_ground;
    }
    meets_ground | is_in_reach_of_solids(cx, start, end - start)
}

/// Returns true for ways that may lead into solid parts, or are longer than the reach of their lists.
#[inline(always)]
pub fn is_in_reach_of_solids<R: Real>(cx: &Context<'_>, start: Vec3<R>, way: Vec3<R>) -> R::Mask {
    let reach_m = cx.scene.solids.reach_m;
    may_meet_solids_on_way(cx, start, way) | start.x.all(reach_m * reach_m).less_than(vec3_dot(way, way))
}

/// Returns true if a particle at rest checks the wind and what holds it in a step: in one of eight, by its number.
#[inline(always)]
pub fn rest_is_checked(cx: &Context<'_>, id: u32) -> bool {
    (cx.step.index.wrapping_add(id) & 7) == 0
}

/// Lets the particle in a slot be born if one of the numbers of a step falls on it, or an event of its parent does, and returns the part
/// of the step that is left to it. `parents` are the particles in slots before those of its population.
#[inline(always)]
pub fn slot_birth(
    cx: &Context<'_>,
    particle: &mut ParticleMut<'_>,
    parents: &ParticleRows<'_>,
    slot: u32,
    change: &mut ParticleChange,
) -> f32 {
    let number = particle_population(particle.place.bits);
    let population = &cx.scene.populations[number as usize];
    let nest = &population.nest;
    if (population.flags & POPULATION_BRANCH_SNOW) != 0 {
        let row = fall_row(cx, slot - population.first_slot);
        if row == NEVER || particle_state(particle.place.bits) == PARTICLE_ALIVE {
            return 1.0;
        }
        change.born = 1;
        particle_birth(cx, particle, number, row);
        particle.place.position = fall_start(cx, row).to_array();
        return 1.0;
    }
    if nest.fan == 0 {
        let birth = &cx.step.births[number as usize];
        let among = birth_number(birth, population.count, slot - population.first_slot);
        if among == NEVER {
            return 1.0;
        }
        change.born = 1;
        return particle_birth(cx, particle, number, birth.first_id + among);
    }
    let place = nest_place(nest, slot - population.first_slot);
    let row = (nest.parent_slot + place.parent) as usize;
    let (from, motion, id) = (&parents.place[row], &parents.motion[row], parents.traits[row].id);
    let events = nest_events(cx, nest, from.bits, motion.birth, id, place.round);
    change.born = events.count;
    if events.count == 0 {
        return 1.0;
    }
    let own_id = nest_id(nest, id, events.last, place.ordinal);
    let rest = nest_rest(nest, from.bits, particle_birth(cx, particle, number, own_id));
    let own = ParticleFlight {
        position: particle.place.position.into(),
        velocity: particle.motion.velocity.into(),
    };
    let parent = ParticleFlight { position: from.position.into(), velocity: motion.velocity.into() };
    let mut start = nest_start(cx, nest, own, parent, rest);
    if population.meets != MEETS_NOTHING {
        start.position = particle_push(cx, start.position, cx.scene.dt_s * (1.0 - rest));
    }
    particle.place.position = start.position.to_array();
    particle.motion.velocity = start.velocity.to_array();
    rest
}

/// Frame of the parent of the particle in a slot, in which it moves for so many seconds of the step if it is born in it.
#[inline(always)]
pub fn slot_frame(
    cx: &Context<'_>,
    population: &PopulationBlock,
    parents: &ParticleRows<'_>,
    slot: u32,
    birth: u32,
    new_way_s: f32,
) -> ParticleFrame {
    let nest = &population.nest;
    let row = (nest.parent_slot + nest_place(nest, slot - population.first_slot).parent) as usize;
    let frame = parent_frame(&parents.place[row], &parents.motion[row], &parents.starts[row], birth);
    if birth == cx.step.index { rest_frame(frame, new_way_s) } else { frame }
}

/// Steps the particle in a slot, on which others of its population act with an acceleration. `parents` are the particles in slots before
/// those of its population, which have gone through the step. `begin` takes its flight at the start, or at its birth in the step.
#[inline(always)]
pub fn particle_step(
    cx: &Context<'_>,
    particle: &mut ParticleMut<'_>,
    parents: &ParticleRows<'_>,
    slot: u32,
    mutual: Vec3,
    begin: &mut ParticleStart,
) -> ParticleChange {
    let mut change = ParticleChange::default();
    let population = &cx.scene.populations[particle_population(particle.place.bits) as usize];
    let before = particle_state(particle.place.bits);
    let was_alive = before == PARTICLE_ALIVE || before == PARTICLE_RESTING;
    let is_over = was_alive && life_is_over(cx, particle.motion.birth, particle.traits.life_size);
    if (population.flags & POPULATION_ON_LEAVES) != 0 {
        begin.position = particle.place.position;
        begin.velocity = particle.motion.velocity;
        return leaf_particle_step(cx, particle);
    }
    particle.place.bits &= !PARTICLE_MARKS;
    let rest = slot_birth(cx, particle, parents, slot, &mut change);
    let is_new = change.born != 0;
    if is_new {
        change.cut_short = change.born - 1 + u32::from(was_alive);
    } else if is_over {
        particle.place.bits = with_particle_state(particle.place.bits, PARTICLE_DEAD) | PARTICLE_DIED;
        change.died = 1;
    }
    begin.position = particle.place.position;
    begin.velocity = particle.motion.velocity;
    if is_new {
        if rest <= 0.0 {
            return change;
        }
    } else if !was_alive
        || is_over
        || (before == PARTICLE_RESTING && !rest_wakes(cx, population, particle.traits.id))
    {
        return change;
    }
    let mut bits = particle.place.bits;
    let start = ParticleFlight {
        position: particle.place.position.into(),
        velocity: particle.motion.velocity.into(),
    };
    // The newborn feels others from its next step on.
    let mutual = if is_new { Vec3::ZERO } else { mutual };
    let time = cx.scene.dt_s * rest;
    let is_local = (population.flags & POPULATION_LOCAL) != 0;
    let mut inside = start;
    let mut frame = ParticleFrame::WORLD;
    if is_local {
        frame = slot_frame(cx, population, parents, slot, particle.motion.birth, time);
        inside = in_frame(frame, start);
    }
    // The newborn meets the air at once.
    let coasts = !is_new && particle_coasts(cx, population, slot);
    let mut end = particle_free_step(cx, population, coasts, inside, particle.traits.air, mutual);
    if rest < 1.0 {
        end.position = inside.position + (end.position - inside.position) * rest;
        end.velocity = inside.velocity + (end.velocity - inside.velocity) * rest;
    }
    if is_local {
        end = carried_flight(frame, end);
    }
    let mut state = PARTICLE_ALIVE;
    bits &= !PARTICLE_GROUNDED;
    if may_be_struck(cx, population, start.position, end.position) {
        let contact = particle_contact(cx, population, start, end, cx.scene.dt_s - time, time);
        end = contact.flight;
        if contact.held_by == NEVER {
            end.position = particle_push(cx, end.position, cx.scene.dt_s);
        } else {
            state = PARTICLE_RESTING;
            end.velocity = Vec3::ZERO;
            if before == PARTICLE_RESTING && !is_new {
                end.position = particle_push(cx, start.position, cx.scene.dt_s);
            }
            if contact.held_by == STRIKE_GROUND {
                bits |= PARTICLE_GROUNDED;
            }
        }
        if contact.dies {
            state = PARTICLE_DEAD;
        }
        change.hits = contact.hits;
        change.stopped = u32::from(contact.is_stopped);
    }
    if change.hits != 0 {
        bits = with_more_hits(bits, change.hits);
    }
    end.position = through_sides(population, end.position);
    if is_outside(population, end.position) {
        state = PARTICLE_DEAD;
    }
    if state == PARTICLE_DEAD {
        change.died += 1;
        bits |= PARTICLE_DIED;
    }
    particle.place.position = end.position.to_array();
    particle.place.bits = with_particle_state(bits, state);
    particle.motion.velocity = end.velocity.to_array();
    change
}

/// Steps a particle that is where a leaf burns: the leaf moves it.
#[inline(always)]
pub fn leaf_particle_step(cx: &Context<'_>, particle: &mut ParticleMut<'_>) -> ParticleChange {
    let mut change = ParticleChange::default();
    let is_alive = particle_state(particle.place.bits) == PARTICLE_ALIVE;
    if is_alive && particle.motion.birth == cx.step.index {
        change.born = 1;
        return change;
    }
    particle.place.bits &= !PARTICLE_MARKS;
    if is_alive && life_is_over(cx, particle.motion.birth, particle.traits.life_size) {
        particle.place.bits = with_particle_state(particle.place.bits, PARTICLE_DEAD) | PARTICLE_DIED;
        change.died = 1;
    }
    change
}

/// Returns true if a particle at rest is moved on in a step, to see if it stays there.
#[inline(always)]
pub fn rest_wakes(cx: &Context<'_>, population: &PopulationBlock, id: u32) -> bool {
    population.meets != MEETS_STICK && rest_is_checked(cx, id)
}

/// Returns true for states of particles to which nothing happens until they are born.
#[inline(always)]
pub fn is_unborn<W: Word>(bits: W) -> W::Mask {
    let state = particle_state(bits);
    state.equals(PARTICLE_DORMANT) | state.equals(PARTICLE_DEAD)
}
