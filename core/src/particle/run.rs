// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps runs of particles one after another.

use super::store::{ParticleStore, ParticlesMut, TallyStore};
use crate::context::Context;
use crate::device::particle::record::{
    TALLY_BORN, TALLY_CUT_SHORT, TALLY_DIED, TALLY_HITS, TALLY_STOPPED, TALLY_WORDS, particle_population,
};
use crate::device::particle::step::{ParticleChange, particle_step};

/// Adds what has happened to a particle to the counts of its population.
#[inline(always)]
pub fn add_to_tally(counts: &mut [u32], population: u32, change: &ParticleChange) {
    let first = (population * TALLY_WORDS) as usize;
    let ParticleChange { born, died, hits, stopped, cut_short } = *change;
    for (place, count) in [
        (TALLY_BORN, born),
        (TALLY_DIED, died),
        (TALLY_HITS, hits),
        (TALLY_STOPPED, stopped),
        (TALLY_CUT_SHORT, cut_short),
    ] {
        let sum = &mut counts[first + place as usize];
        *sum = sum.wrapping_add(count);
    }
}

/// Steps the particles of a run of slots from `first` on.
pub(crate) fn step_run(cx: &Context<'_>, run: &mut ParticlesMut<'_>, first: u32, counts: &mut [u32]) {
    for (slot, mut particle) in (first..).zip(run.iter_mut()) {
        let population = particle_population(particle.place.bits);
        let change = particle_step(cx, &mut particle, slot);
        add_to_tally(counts, population, &change);
    }
}

/// Steps all particles of a world.
pub(crate) fn step_all(cx: &Context<'_>, particles: &mut ParticleStore, tallies: &mut TallyStore) {
    step_run(cx, &mut particles.as_mut(), 0, &mut tallies.count);
}
