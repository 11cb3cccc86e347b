// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps runs of particles one after another.

use super::store::{ParticleRows, ParticleStore, ParticlesMut, TallyStore};
use crate::arith::vector::Vec3;
use crate::blocks::{PopulationBlock, SceneBlock};
use crate::context::Context;
use crate::convert::len32;
use crate::device::particle::force_carrier::{CarrierRun, carrier_rows};
use crate::device::particle::mutual::{mutual_pull, mutual_source};
use crate::device::particle::on_leaf::{FollowedLeaf, LeafParticles, particle_on_leaf};
use crate::device::particle::record::{
    POPULATION_MUTUAL, POPULATION_ON_LEAVES, ParticleStart, TALLY_BORN, TALLY_CUT_SHORT, TALLY_DIED,
    TALLY_HITS, TALLY_STOPPED, TALLY_WORDS, particle_population,
};
use crate::device::particle::step::{ParticleChange, particle_step};
use crate::leaf::{Burns, Leaves};

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

/// Rows of all carriers of forces where they are at the start of a step, in the place of those of the step before.
pub fn place_carriers(
    cx: &Context<'_>,
    runs: &[CarrierRun],
    particles: &ParticleStore,
    rows: &mut Vec<[f32; 4]>,
) {
    rows.clear();
    for run in runs {
        let slots = run.first as usize..(run.first + run.count) as usize;
        rows.extend(slots.flat_map(|slot| {
            carrier_rows(cx, run, &particles.place[slot], &particles.motion[slot], &particles.traits[slot])
        }));
    }
}

/// The populations of a scene whose particles are where leaves burn.
pub fn leaf_particles(scene: &SceneBlock, leaves: u32) -> impl Iterator<Item = LeafParticles> {
    let on_leaves = |(_, block): &(u32, &PopulationBlock)| (block.flags & POPULATION_ON_LEAVES) != 0;
    let of = move |(population, block): (u32, &PopulationBlock)| LeafParticles {
        first: block.first_slot,
        count: leaves,
        first_leaf: 0,
        population,
    };
    (0..).zip(&scene.populations).filter(on_leaves).map(of)
}

/// Lets the particles of burning leaves be where these are at the end of a step.
pub(crate) fn follow_leaves(cx: &Context<'_>, leaves: &Leaves, burns: &Burns, particles: &mut ParticleStore) {
    let mut particles = particles.as_mut();
    for run in leaf_particles(cx.scene, len32(leaves.len())) {
        for (slot, burn) in (0..).zip(&burns.burn) {
            let (place, drift) = (&leaves.place[slot as usize], &leaves.drift[slot as usize]);
            let mut particle = particles.row_mut((run.first + slot) as usize);
            let (at, velocity) = (place.position.into(), drift.velocity.into());
            let leaf = FollowedLeaf { slot, bits: place.bits, place: at, velocity };
            particle_on_leaf(cx, &mut particle, run.population, &leaf, burn);
        }
    }
}

/// Particles that do not see each other, and go through a step together.
#[derive(Debug)]
pub struct Generation<'a> {
    /// All that go through the step before them, their parents among these.
    pub parents: ParticleRows<'a>,
    /// First slot.
    pub first: u32,
    /// The particles.
    pub particles: ParticlesMut<'a>,
    /// Their flights at the start of the step; empty where none go along with others.
    pub starts: &'a mut [ParticleStart],
}

impl<'a> Generation<'a> {
    /// The particles up to a slot, `count` from the first, and those behind it.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let Self { parents, first, particles, starts } = self;
        let (front, back) = particles.split_at(count);
        let (front_starts, back_starts) = starts.split_at_mut(count.min(starts.len()));
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
        let next = first + count as u32;
        (
            Generation { parents, first, particles: front, starts: front_starts },
            Generation { parents, first: next, particles: back, starts: back_starts },
        )
    }
}

/// Calls `step` with one generation of particles after another; there is one if no particles are born of others. `starts` are as many as
/// particles, or none.
pub fn each_generation(
    populations: &[PopulationBlock],
    particles: &mut ParticleStore,
    starts: &mut [ParticleStart],
    mut step: impl FnMut(Generation<'_>),
) {
    let mut first = 0;
    let mut next = |end: u32| {
        let (earlier, rest) = particles.as_mut().split_at(first as usize);
        let (earlier_starts, starts) = starts.split_at_mut(starts.len().min(first as usize));
        let all = Generation { parents: earlier.rows(earlier_starts), first, particles: rest, starts };
        step(all.split_at((end - first) as usize).0);
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

/// Steps particles of a generation, on which others act with accelerations.
pub(crate) fn step_run(cx: &Context<'_>, run: &mut Generation<'_>, pulls: &[Vec3], counts: &mut [u32]) {
    let mut starts = run.starts.iter_mut();
    for (slot, mut particle) in (run.first..).zip(run.particles.iter_mut()) {
        let population = particle_population(particle.place.bits);
        let pull = pulls.get(slot as usize).copied().unwrap_or(Vec3::ZERO);
        let mut spare = bytemuck::Zeroable::zeroed();
        let begin = starts.next().unwrap_or(&mut spare);
        let change = particle_step(cx, &mut particle, &run.parents, slot, pull, begin);
        add_to_tally(counts, population, &change);
    }
}

/// Steps all particles of a world, some of which carry forces; `start_count` is that of flights that others go along with.
pub(crate) fn step_all(
    cx: &Context<'_>,
    carriers: &[CarrierRun],
    start_count: usize,
    particles: &mut ParticleStore,
    tallies: &mut TallyStore,
) {
    let pulls = mutual_pulls(cx, particles);
    let mut places = Vec::new();
    place_carriers(cx, carriers, particles, &mut places);
    let cx = &cx.with_carriers(&places);
    let mut starts = vec![bytemuck::Zeroable::zeroed(); start_count];
    each_generation(&cx.scene.populations, particles, &mut starts, |mut run| {
        step_run(cx, &mut run, &pulls, &mut tallies.count);
    });
}
