// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The particle store, and the counts of what has happened to each population.

use crate::device::particle::record::{
    PARTICLE_DORMANT, ParticleMotion, ParticlePlace, ParticleStart, ParticleTraits, TALLY_WORDS,
    particle_bits,
};
use crate::scene::Scene;

crate::columns! {
    /// All particles of a world, population after population. Index = slot.
    pub struct ParticleStore("particles") {
        /// Position and flags.
        pub place: ParticlePlace,
        /// Velocity and birth.
        pub motion: ParticleMotion,
        /// Numbers that stay for a life.
        pub traits: ParticleTraits,
    }
    /// The records of one particle.
    row ParticleMut;
    /// A run of particles whose columns can be split.
    run ParticlesMut;
}

/// Columns of particles that are only read.
#[derive(Clone, Copy, Debug)]
pub struct ParticleRows<'a> {
    /// Positions and flags.
    pub place: &'a [ParticlePlace],
    /// Velocities and births.
    pub motion: &'a [ParticleMotion],
    /// Numbers that stay for a life.
    pub traits: &'a [ParticleTraits],
    /// Flights at the start of the step; empty where no particles go along with others.
    pub starts: &'a [ParticleStart],
}

impl ParticlesMut<'_> {
    /// The same, to be read only, with their flights at the start of the step.
    pub fn rows<'a>(&'a self, starts: &'a [ParticleStart]) -> ParticleRows<'a> {
        ParticleRows { place: self.place, motion: self.motion, traits: self.traits, starts }
    }
}

/// Bytes that one step of one particle moves without an event: place and motion are read and written, traits are read.
pub const HOT_BYTES_PER_STEP: usize =
    2 * (size_of::<ParticlePlace>() + size_of::<ParticleMotion>()) + size_of::<ParticleTraits>();

crate::columns! {
    /// Counts of what has happened to particles since the scene began: [`TALLY_WORDS`] for each population.
    pub struct TallyStore("particle counts") {
        /// The counts.
        pub count: u32,
    }
    /// One count.
    row TallyMut;
    /// A run of counts.
    run TalliesMut;
}

impl TallyStore {
    /// Number of rows for a scene.
    pub(crate) fn rows_of(scene: &Scene) -> usize {
        scene.particles.len() * TALLY_WORDS as usize
    }
}

impl ParticleStore {
    /// The store of a scene, in which no particle is born yet.
    pub(crate) fn dormant(scene: &Scene) -> Self {
        let mut store = Self::zeroed(scene.particle_count() as usize);
        let populations = (0..).zip(&scene.particles);
        let slots = populations.flat_map(|(number, particles)| (0..particles.count).map(move |_| number));
        for (place, number) in store.place.iter_mut().zip(slots) {
            place.bits = particle_bits(PARTICLE_DORMANT, number);
        }
        store
    }
}
