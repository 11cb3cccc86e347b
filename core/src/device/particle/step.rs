// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/step.wgsl
//!
//! One step of one particle, in the order of deaths, births, forces, hits, places.

use super::birth::{birth_number, particle_birth};
use super::fly::{ParticleFlight, particle_fly};
use super::record::{
    MEETS_NOTHING, MEETS_STICK, PARTICLE_ALIVE, PARTICLE_BORN, PARTICLE_DEAD, PARTICLE_DIED,
    PARTICLE_DORMANT, PARTICLE_GROUNDED, PARTICLE_HIT, PARTICLE_RESTING, particle_life, particle_population,
    particle_state, with_more_hits, with_particle_state,
};
use super::strike::{STRIKE_GROUND, particle_contact, particle_push};
use crate::arith::lane::{Real, Word};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::{NEVER, PopulationBlock};
use crate::context::Context;
use crate::device::solid::near::may_meet_solids;
use crate::device::terrain::ground::ground_met;
use crate::particle::ParticleMut;

/// Events of a particle in a step, to be added to the counts of its population.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ParticleChange {
    /// Births.
    pub born: u32,
    /// Deaths.
    pub died: u32,
    /// Hits.
    pub hits: u32,
    /// 1 if its fourth hit stopped it.
    pub stopped: u32,
    /// 1 if the slot was needed before its life was over.
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
    let way = end - start;
    let reach = cx.scene.solids.reach_m;
    let is_near = may_meet_solids(cx, start) | start.x.all(reach * reach).less_than(vec3_dot(way, way));
    meets_ground | is_near
}

/// Returns true if a particle at rest looks at the wind and at what holds it in a step: in one of eight.
#[inline(always)]
pub fn rest_is_checked(cx: &Context<'_>, slot: u32) -> bool {
    ((cx.step.index + slot) & 7) == 0
}

/// Steps the particle in a slot, on which others of its population act with an acceleration.
#[inline(always)]
pub fn particle_step(
    cx: &Context<'_>,
    particle: &mut ParticleMut<'_>,
    slot: u32,
    mutual: Vec3,
) -> ParticleChange {
    let mut change = ParticleChange::default();
    let number = particle_population(particle.place.bits);
    let population = &cx.scene.populations[number as usize];
    let birth = &cx.step.births[number as usize];
    let before = particle_state(particle.place.bits);
    let mut is_alive = before == PARTICLE_ALIVE || before == PARTICLE_RESTING;
    let mut bits = particle.place.bits & !(PARTICLE_BORN | PARTICLE_DIED | PARTICLE_HIT);
    if is_alive && life_is_over(cx, particle.motion.birth, particle.traits.life_size) {
        bits = with_particle_state(bits, PARTICLE_DEAD) | PARTICLE_DIED;
        change.died += 1;
        is_alive = false;
    }
    particle.place.bits = bits;
    let mut rest = 1.0;
    let among = birth_number(birth, population.count, slot - population.first_slot);
    if among != NEVER {
        change.cut_short = u32::from(is_alive);
        change.born = 1;
        rest = particle_birth(cx, particle, number, birth.first_id + among);
        bits = particle.place.bits;
        is_alive = true;
    }
    if !is_alive || (among == NEVER && before == PARTICLE_RESTING && !rest_wakes(cx, population, slot)) {
        return change;
    }
    let start = ParticleFlight {
        position: particle.place.position.into(),
        velocity: particle.motion.velocity.into(),
    };
    // The newborn feels others from its next step on.
    let mutual = if among == NEVER { mutual } else { Vec3::ZERO };
    let mut end = particle_fly(cx, population, start, particle.traits.air, mutual);
    let time = cx.scene.dt_s * rest;
    if rest < 1.0 {
        end.position = start.position + (end.position - start.position) * rest;
        end.velocity = start.velocity + (end.velocity - start.velocity) * rest;
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
            if before == PARTICLE_RESTING && among == NEVER {
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

/// Returns true if a particle at rest is moved on in a step, to see if it stays there.
#[inline(always)]
pub fn rest_wakes(cx: &Context<'_>, population: &PopulationBlock, slot: u32) -> bool {
    population.meets != MEETS_STICK && rest_is_checked(cx, slot)
}

/// Returns true for states of particles to which nothing happens until they are born.
#[inline(always)]
pub fn is_unborn<W: Word>(bits: W) -> W::Mask {
    let state = particle_state(bits);
    state.equals(PARTICLE_DORMANT) | state.equals(PARTICLE_DEAD)
}
