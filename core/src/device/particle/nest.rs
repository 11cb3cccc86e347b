// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/nest.wgsl
//!
//! Births of particles by others. A slot asks its parent, which has gone through the step before it, if an event fell on it: so no event
//! is written down anywhere, none is lost and none comes twice, and no order of threads matters.

use super::fly::ParticleFlight;
use super::record::{
    PARTICLE_ALIVE, PARTICLE_BORN, PARTICLE_DIED, PARTICLE_HIT, PARTICLE_RESTING, particle_hits,
    particle_state, particle_struck,
};
use crate::blocks::NestBlock;
use crate::context::Context;

crate::shared_constants! {
    /// Children of a birth.
    pub const NEST_BIRTH: u32 = 0;
    /// Children of a death.
    pub const NEST_DEATH: u32 = 1;
    /// Children of a hit.
    pub const NEST_HIT: u32 = 2;
    /// Children born again and again.
    pub const NEST_EVERY: u32 = 3;
    /// Difference between the numbers of the children of one event and of the next: 2^32 over the golden ratio, so that numbers of a life
    /// lie far apart, and children of neighbours between them.
    pub const NEST_SPACING: u32 = 0x9e37_79b1;
}

/// Share of a slot in the births of its parent.
#[derive(Clone, Copy, Debug)]
pub struct NestPlace {
    /// Place of the parent among its population.
    pub parent: u32,
    /// Events that it takes part in: one in so many, as there are rounds.
    pub round: u32,
    /// Its number among those that are born at once.
    pub ordinal: u32,
}

/// Events of a parent in a step that fall on one round.
#[derive(Clone, Copy, Debug)]
pub struct NestEvents {
    /// Number of them.
    pub count: u32,
    /// Number of the last within the parent's life.
    pub last: u32,
}

/// Share of the slot at a place of its population in the births of its parent: all children of a parent lie side by side.
#[inline(always)]
pub fn nest_place(nest: &NestBlock, place: u32) -> NestPlace {
    let group = place / nest.fan;
    let parent = group / nest.rounds;
    NestPlace { parent, round: group - parent * nest.rounds, ordinal: place - group * nest.fan }
}

/// Events in a step that fall on a round, of a parent with these bits, birth and number. Rounds take turns with the events of a life, and
/// with the lives of a slot; where children are born again and again with time, so that a slot's next parent goes on with the next round.
#[inline(always)]
pub fn nest_events(
    cx: &Context<'_>,
    nest: &NestBlock,
    bits: u32,
    birth: u32,
    id: u32,
    round: u32,
) -> NestEvents {
    let count;
    let mut first = 0;
    // Lives of a slot of parents with numbers in a row.
    let mut turn = id / nest.parent_count;
    if nest.event == NEST_BIRTH {
        count = u32::from((bits & PARTICLE_BORN) != 0);
    } else if nest.event == NEST_DEATH {
        count = u32::from((bits & PARTICLE_DIED) != 0);
    } else if nest.event == NEST_HIT {
        count = particle_struck(bits);
        first = particle_hits(bits).wrapping_sub(count);
        turn = turn.wrapping_add(first);
    } else {
        let state = particle_state(bits);
        let age = cx.step.index.wrapping_sub(birth);
        first = age / nest.steps;
        turn = cx.step.index.wrapping_sub(nest.first_step) / nest.steps;
        let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
        count = u32::from(is_alive && first != 0 && age == first * nest.steps);
    }
    let ahead = (round + nest.rounds - turn % nest.rounds) % nest.rounds;
    if count <= ahead {
        return NestEvents { count: 0, last: 0 };
    }
    let more = (count - 1 - ahead) / nest.rounds;
    NestEvents { count: more + 1, last: first.wrapping_add(ahead + more * nest.rounds) }
}

/// Number of a child, by those of its parent, of the event and of the child among its siblings.
#[inline(always)]
pub fn nest_id(nest: &NestBlock, parent: u32, event: u32, ordinal: u32) -> u32 {
    (parent.wrapping_mul(nest.fan).wrapping_add(ordinal)).wrapping_add(event.wrapping_mul(NEST_SPACING))
}

/// Part of a step that is left to a child, which draws `moment`. Only on a way without a hit it is known where the parent was before.
#[inline(always)]
pub fn nest_rest(nest: &NestBlock, bits: u32, moment: f32) -> f32 {
    if nest.event == NEST_EVERY && (bits & PARTICLE_HIT) == 0 { moment } else { 0.0 }
}

/// Start of a child, which lies `own` from its parent: where that was when `rest` of the step was left.
#[inline(always)]
pub fn nest_start(
    cx: &Context<'_>,
    nest: &NestBlock,
    own: ParticleFlight,
    parent: ParticleFlight,
    rest: f32,
) -> ParticleFlight {
    ParticleFlight {
        position: own.position + (parent.position - parent.velocity * (cx.scene.dt_s * rest)),
        velocity: own.velocity + parent.velocity * nest.inherit,
    }
}
