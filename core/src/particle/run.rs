// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps runs of particles one after another.

use super::store::{ParticleRows, ParticleStore, ParticlesMut, TallyStore};
use crate::arith::vector::Vec3;
use crate::blocks::PopulationBlock;
use crate::context::Context;
use crate::device::particle::mutual::{mutual_pull, mutual_source};
use crate::device::particle::record::{
    POPULATION_MUTUAL, TALLY_BORN, TALLY_CUT_SHORT, TALLY_DIED, TALLY_HITS, TALLY_STOPPED, TALLY_WORDS,
    particle_population,
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

/// Accelerations of all particles by others of their populations in m/s², slot by slot; empty where none attract one another.
pub(crate) fn mutual_pulls(cx: &Context<'_>, particles: &ParticleStore) -> Vec<Vec3> {
    let is_mutual = |population: &PopulationBlock| (population.flags & POPULATION_MUTUAL) != 0;
    if !cx.scene.populations.iter().any(is_mutual) {
        return Vec::new();
    }
    let mut pulls = vec![Vec3::ZERO; particles.len()];
    for population in cx.scene.populations.iter().filter(|population| is_mutual(population)) {
        let slots = population.first_slot as usize..(population.first_slot + population.count) as usize;
        let rows = particles.place[slots.clone()].iter().zip(&particles.motion[slots.clone()]);
        let sources: Vec<_> =
            rows.map(|(place, motion)| mutual_source(cx, population, place, motion)).collect();
        for (pull, [x, y, z, _]) in pulls[slots].iter_mut().zip(&sources) {
            let middle = Vec3::new(*x, *y, *z);
            *pull =
                sources.iter().fold(Vec3::ZERO, |sum, source| mutual_pull(population, sum, middle, *source));
        }
    }
    pulls
}

/// Calls `step` with particles that do not see each other, one run of slots after another: all that go through a step before them, their
/// parents among these, the first slot, and the run. There is one run if no particles are born of others.
pub fn each_generation(
    populations: &[PopulationBlock],
    particles: &mut ParticleStore,
    mut step: impl FnMut(&ParticleRows<'_>, u32, ParticlesMut<'_>),
) {
    let mut first = 0;
    let mut next = |end: u32| {
        let (earlier, rest) = particles.as_mut().split_at(first as usize);
        let (run, _) = rest.split_at((end - first) as usize);
        step(&earlier.rows(), first, run);
        first = end;
    };
    let mut begin = 0;
    let mut end = 0;
    for population in populations {
        if population.nest.fan != 0 && begin <= population.nest.parent_slot {
            begin = population.first_slot;
            next(begin);
        }
        end = end.max(population.first_slot + population.count);
    }
    next(end);
}

/// Steps the particles of a run of slots from `first` on, on which others act with accelerations, behind their parents.
pub(crate) fn step_run(
    cx: &Context<'_>,
    run: &mut ParticlesMut<'_>,
    parents: &ParticleRows<'_>,
    first: u32,
    pulls: &[Vec3],
    counts: &mut [u32],
) {
    for (slot, mut particle) in (first..).zip(run.iter_mut()) {
        let population = particle_population(particle.place.bits);
        let pull = pulls.get(slot as usize).copied().unwrap_or(Vec3::ZERO);
        let change = particle_step(cx, &mut particle, parents, slot, pull);
        add_to_tally(counts, population, &change);
    }
}

/// Steps all particles of a world.
pub(crate) fn step_all(cx: &Context<'_>, particles: &mut ParticleStore, tallies: &mut TallyStore) {
    let pulls = mutual_pulls(cx, particles);
    each_generation(&cx.scene.populations, particles, |parents, first, mut run| {
        step_run(cx, &mut run, parents, first, &pulls, &mut tallies.count);
    });
}
