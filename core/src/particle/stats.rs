// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counts over the populations of particles.

use super::store::{ParticleStore, TallyStore};
use crate::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_RESTING, TALLY_BORN, TALLY_CUT_SHORT, TALLY_DIED, TALLY_HITS, TALLY_STOPPED,
    TALLY_WORDS, particle_state,
};
use crate::scene::Scene;

/// Counts over one population at one step. All that were born have died, were cut short or are alive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParticleStats {
    /// Name of the population.
    pub name: String,
    /// Slots.
    pub slots: u32,
    /// Particles alive, at rest or not.
    pub alive: u32,
    /// Births since the first, those before time zero included; they are counted modulo 2^32, as are the following.
    pub born: u32,
    /// Deaths by age, region or hit.
    pub died: u32,
    /// Hits; particles that slide or rest do not hit.
    pub hits: u32,
    /// Steps in which a particle was stopped by its fourth hit.
    pub stopped: u32,
    /// Lives that ended since the slot was needed for the next.
    pub cut_short: u32,
}

impl ParticleStats {
    /// Counts over all populations of a scene, in its order.
    pub(crate) fn of(scene: &Scene, particles: &ParticleStore, tallies: &TallyStore) -> Vec<Self> {
        let mut places = particles.place.iter();
        let counts = tallies.count.chunks(TALLY_WORDS as usize);
        scene
            .particles
            .iter()
            .zip(counts)
            .map(|(population, counts)| {
                let own = places.by_ref().take(population.count as usize);
                let is_alive = |bits| matches!(particle_state(bits), PARTICLE_ALIVE | PARTICLE_RESTING);
                let alive = own.map(|place| u32::from(is_alive(place.bits))).sum();
                let count = |place: u32| counts[place as usize];
                Self {
                    name: population.name.clone(),
                    slots: population.count,
                    alive,
                    born: count(TALLY_BORN),
                    died: count(TALLY_DIED),
                    hits: count(TALLY_HITS),
                    stopped: count(TALLY_STOPPED),
                    cut_short: count(TALLY_CUT_SHORT),
                }
            })
            .collect()
    }
}
