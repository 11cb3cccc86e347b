// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A living particle as tables and exports have it.

use std::io::Write;

use windfall_core::World;
use windfall_core::device::particle::air::PARTICLE_SIZE_UNIT;
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_RESTING, particle_life, particle_size, particle_state,
};

use crate::files::{CsvFile, WriteError};

/// Columns of a particle in tables.
const PARTICLE_COLUMNS: [&str; 12] = [
    "population",
    "particle",
    "id",
    "state",
    "age_s",
    "x_m",
    "y_m",
    "z_m",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "size_m",
];

/// Header of a table with the columns of a particle behind others.
pub(crate) fn header(before: &[&'static str]) -> Vec<&'static str> {
    [before, &PARTICLE_COLUMNS].concat()
}

/// A particle at one moment. Slots without a living one have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LiveParticle {
    /// Number of its population in the scene.
    pub(crate) population: usize,
    /// Its slot among those of its population, from 0: another particle's after its death.
    pub(crate) slot: u32,
    /// Its number among all particles of its population that are ever born.
    pub(crate) id: u32,
    /// True if it rests on something.
    pub(crate) is_resting: bool,
    /// Time since the beginning of the step of its birth in s.
    pub(crate) age_s: f32,
    /// Age as a share of the life; 0 if age does not end it.
    pub(crate) age_share: f32,
    /// Place in m.
    pub(crate) position_m: [f32; 3],
    /// Velocity in m/s.
    pub(crate) velocity_m_s: [f32; 3],
    /// Diameter in m.
    pub(crate) size_m: f32,
}

impl LiveParticle {
    /// The particle in a slot of a population, if one lives there.
    fn of(world: &World, population: usize, slot: u32) -> Option<Self> {
        let first_slot = world.compiled.block().populations[population].first_slot;
        let row = (first_slot + slot) as usize;
        let (place, motion, traits) =
            (world.particles.place[row], world.particles.motion[row], world.particles.traits[row]);
        let state = particle_state(place.bits);
        let age = world.clock.step().wrapping_sub(motion.birth);
        #[expect(clippy::cast_possible_truncation, reason = "seconds of a life")]
        let age_s = (f64::from(age) * f64::from(world.clock.dt_s())) as f32;
        let life = particle_life(traits.life_size);
        let age_share = if life == 0 { 0.0 } else { (age as f32 / life as f32).min(1.0) };
        let mean_m = world.compiled.scene().particles[population].size_m.mean();
        matches!(state, PARTICLE_ALIVE | PARTICLE_RESTING).then(|| Self {
            population,
            slot,
            id: traits.id,
            is_resting: state == PARTICLE_RESTING,
            age_s,
            age_share,
            position_m: place.position,
            velocity_m_s: motion.velocity,
            size_m: particle_size(traits.life_size) as f32 * PARTICLE_SIZE_UNIT * mean_m,
        })
    }

    /// Those that live in the first `most` slots of a population, slot by slot.
    pub(crate) fn first_of(world: &World, population: usize, most: u32) -> impl Iterator<Item = Self> {
        // Particles are all in the first shard.
        let most = if world.compiled.shard().is_first() { most } else { 0 };
        let slots = world.compiled.scene().particles[population].count.min(most);
        (0..slots).filter_map(move |slot| Self::of(world, population, slot))
    }

    /// All of a world, population after population.
    pub(crate) fn all(world: &World) -> impl Iterator<Item = Self> {
        let populations = 0..world.compiled.scene().particles.len();
        populations.flat_map(|population| Self::first_of(world, population, u32::MAX))
    }

    /// Adds its fields to a row and ends that; `population` is the name of its population.
    pub(crate) fn write<W: Write>(&self, population: &str, table: &mut CsvFile<W>) -> Result<(), WriteError> {
        table.field(population).field(self.slot).field(self.id);
        table.field(if self.is_resting { "resting" } else { "flying" }).field(self.age_s);
        for number in self.position_m.iter().chain(&self.velocity_m_s) {
            table.field(number);
        }
        table.field(self.size_m).end_row()
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use windfall_core::Scene;
    use windfall_core::scene::{Meets, ParticleRelease, Particles, Spread};

    use super::*;

    /// A world of two populations: a burst that has not come, and motes of two centimetres born since two seconds ago.
    fn motes() -> World {
        let late = ParticleRelease::Burst { at_s: 1.0 };
        let early = ParticleRelease::Rate { per_s: 20.0, from_s: -2.0 };
        let scene = Scene {
            particles: vec![
                Particles { name: "late".into(), count: 3, release: late, ..Particles::default() },
                Particles {
                    name: "motes, \"grey\"".into(),
                    count: 80,
                    release: early,
                    life_s: Some(Spread::Constant(3.0)),
                    size_m: Spread::Constant(0.02),
                    meets: Meets::Stick,
                    ..Particles::default()
                },
            ],
            ..Scene::default()
        };
        World::build(&scene).expect("a valid scene")
    }

    #[test]
    fn only_the_living_are_there_with_their_age_and_size() {
        let world = motes();
        let all: Vec<_> = LiveParticle::all(&world).collect();
        let alive = world.particle_stats()[1].alive;
        assert_eq!(all.len(), alive as usize, "the living");
        assert!((39..=41).contains(&alive), "twenty a second for two seconds: {alive}");
        for particle in &all {
            assert_eq!((particle.population, particle.size_m), (1, 0.02), "{particle:?}");
            let age_s = 2.0 - f64::from(particle.id) / 20.0;
            assert!((f64::from(particle.age_s) - age_s).abs() < 0.06, "born in turn: {particle:?}");
        }
        assert_eq!(LiveParticle::first_of(&world, 1, 7).count(), 7, "those of the first slots");
    }

    #[test]
    fn every_row_has_as_many_fields_as_the_header() {
        let world = motes();
        let mut table = CsvFile::new(Vec::new(), Path::new("a.csv"), &header(&[])).expect("room");
        for particle in LiveParticle::all(&world) {
            particle.write("motes", &mut table).expect("as long as the header");
        }
    }
}
