// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles births of particles by others.

use crate::blocks::NestBlock;
use crate::device::particle::nest::{NEST_BIRTH, NEST_DEATH, NEST_EVERY, NEST_HIT};
use crate::scene::{ParticleEvent, Particles, Space};

/// Births of a population by one of those before it, which have slots from `slots` on, in a world that begins `lead` steps before time zero.
pub(super) fn nest_block(
    particles: &Particles,
    earlier: &[Particles],
    slots: &[u32],
    lead: u32,
) -> Option<NestBlock> {
    let nest = particles.nest.as_ref()?;
    let at = earlier.iter().position(|parents| parents.name == nest.of)?;
    let (event, steps) = match nest.on {
        ParticleEvent::Birth => (NEST_BIRTH, 1),
        ParticleEvent::Death => (NEST_DEATH, 1),
        ParticleEvent::Hit => (NEST_HIT, 1),
        ParticleEvent::Every { steps } => (NEST_EVERY, steps),
    };
    Some(NestBlock {
        event,
        steps,
        fan: nest.fan,
        rounds: particles.count / (earlier[at].count * nest.fan),
        parent_slot: slots[at],
        parent_count: earlier[at].count,
        first_step: 0u32.wrapping_sub(lead),
        // In its own frame a parent is at rest.
        inherit: if nest.space == Space::Local { 1.0 } else { nest.inherit },
    })
}
