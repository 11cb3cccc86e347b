// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene brought to life: compiled scene, clock and stores.

use std::sync::{Mutex, PoisonError};

use super::lead::lead_in;
use super::lying_snow::{lie, rounds_of};
use super::stats::Stats;
use crate::arith::hash::mix;
use crate::blocks::{NEVER, StepBlock};
use crate::clock::Clock;
use crate::compile::{CompiledScene, Cycle, Shard, lifetime_steps, release_step};
use crate::context::Context;
use crate::convert::len32;
use crate::device::leaf::air::leaf_sample_air;
use crate::device::leaf::record::leaf_appearance;
use crate::device::leaf::release::leaf_release;
use crate::device::particle::record::{PARTICLE_ALIVE, particle_state};
use crate::error::{SceneError, SimError};
use crate::flight::drop_table::{DropTable, drop_tables};
use crate::leaf::grow::{count_leaves, leaf_grow};
use crate::leaf::seek::leaf_seek_any;
use crate::leaf::{BurnStats, Burns, Leaves, LeavesMut};
use crate::litter::lay::{lay_all, mark_covered, strew};
use crate::litter::{Bed, LitterStats, SnowStats, flakes_of};
use crate::particle::{HistoryStore, ParticleStats, ParticleStore, TallyStore};
use crate::scene::Scene;
use crate::store::{Store, StoreSize, check_sizes, copy_stores, hash_stores, state_bytes};
use crate::threads::on_all;
use crate::tree::Branches;

/// Leaves that a thread places before it takes the next: those that have landed take longer than those in the air.
const RUN: usize = 4096;

/// Everything a simulation consists of, on the host. The exchange type of all backends.
#[derive(Clone, Debug)]
pub struct World {
    /// The compiled scene.
    pub compiled: CompiledScene,
    /// The present.
    pub clock: Clock,
    /// The leaves.
    pub leaves: Leaves,
    /// The trees' segments.
    pub branches: Branches,
    /// The litter.
    pub bed: Bed,
    /// The particles.
    pub particles: ParticleStore,
    /// Counts of what has happened to them.
    pub tallies: TallyStore,
    /// Samples of their ways.
    pub history: HistoryStore,
    /// Burning of the leaves; no row where none burn.
    pub burns: Burns,
}

impl World {
    /// Validates and compiles a scene and fills the store: leaves of later releases dormant, those of earlier ones
    /// where a fall through still air has brought them.
    ///
    /// # Errors
    /// Scenes that [`Scene::validate`] or [`CompiledScene::compile`] reject.
    pub fn build(scene: &Scene) -> Result<Self, SceneError> {
        Self::build_named(scene, &scene.name)
    }

    /// The same for a scene that a file or preset stands for, which errors name.
    ///
    /// # Errors
    /// As [`World::build`].
    pub fn build_named(scene: &Scene, file: &str) -> Result<Self, SceneError> {
        scene.validate(file)?;
        let compiled = CompiledScene::compile(scene).map_err(|error| error.of_file(&scene.name, file))?;
        Self::fill(compiled)
    }

    /// A shard of the world of a scene that a file or preset stands for, which errors name. Its rows are those of the whole, and stay so with
    /// every step; its hash is its share of the sum.
    ///
    /// # Errors
    /// As [`World::build`]; scenes with litter, weather or leaves that burn, and more shards than leaves.
    pub fn build_shard(scene: &Scene, file: &str, shard: Shard) -> Result<Self, SceneError> {
        scene.validate(file)?;
        let compiled =
            CompiledScene::compile_shard(scene, shard).map_err(|error| error.of_file(&scene.name, file))?;
        Self::fill(compiled)
    }

    /// A world that repeats after about `seconds`, to be stepped [`Cycle::run_in`] steps before it does: from then on
    /// every leaf is where another one was [`Cycle::steps`] before, to the bit, and trees nearly so. `file` names the
    /// scene in errors. A checkpoint of it does not go on repeating.
    ///
    /// # Errors
    /// Scenes that [`Cycle::of`] finds cannot repeat, and that [`World::build`] rejects.
    pub fn build_cycle(scene: &Scene, file: &str, seconds: f64) -> Result<(Self, Cycle), SceneError> {
        let (scene, cycle) = Cycle::of(scene, file, seconds)?;
        let compiled = CompiledScene::compile_with(&scene, Some(cycle.clone()))
            .map_err(|error| error.of_file(&scene.name, file))?;
        let mut world = Self::fill(compiled)?;
        cycle.schedule(&scene, &mut world.leaves);
        Ok((world, cycle))
    }

    /// A world of a compiled scene with every word of its stores zero, to be filled.
    pub fn zeroed(compiled: CompiledScene, clock: Clock) -> Self {
        let sizes = compiled.sizes();
        let [leaves, branches, bed, particles, tallies, history, burns] =
            std::array::from_fn(|store| sizes[store].rows);
        let leaves = Leaves::zeroed(leaves);
        let branches = Branches::zeroed(branches);
        let bed = Bed::zeroed(bed);
        let particles = ParticleStore::zeroed(particles);
        let tallies = TallyStore::zeroed(tallies);
        let history = HistoryStore::zeroed(history);
        let burns = Burns::zeroed(burns);
        Self { compiled, clock, leaves, branches, bed, particles, tallies, history, burns }
    }

    /// Fills the stores of a compiled scene.
    fn fill(compiled: CompiledScene) -> Result<Self, SceneError> {
        let clock = Clock::new(compiled.scene().dt_s);
        let mut world = Self::zeroed(compiled, clock);
        world.branches = world.compiled.forest().at_rest();
        if world.compiled.shard().is_first() {
            world.particles = ParticleStore::dormant(world.compiled.scene());
        }
        let Self { compiled, clock, leaves, branches, bed, .. } = &mut world;
        let step = compiled.step_block(clock);
        let cx = compiled.context(&step);
        let tables = drop_tables(&cx);
        let (compiled, still, tables) = (&*compiled, &*branches, tables.as_slice());
        let runs = Mutex::new(runs_of(leaves.as_mut()));
        let next = || runs.lock().unwrap_or_else(PoisonError::into_inner).next();
        on_all(|| {
            while let Some((row, run)) = next() {
                let first = row + compiled.shard_rows().first_row as usize;
                place_leaves(compiled, &cx, still, tables, run, first);
            }
        });
        drop(runs);
        count_leaves(compiled, branches, &cx, leaves);
        if let Some(litter) = &compiled.scene().ground.litter {
            strew(&cx, litter, leaves, leaves.len() - compiled.scene().bed_leaf_count() as usize);
            lay_all(&cx, leaves, bed);
        }
        lead_in(&mut world);
        let step = world.compiled.step_block(&world.clock);
        let cx = world.compiled.context(&step);
        if let Some(weather) = &world.compiled.scene().weather {
            world.bed.snow_mut(cx.scene).cover(&cx, weather.lying_mm);
            let rounds = rounds_of(&world.compiled, weather.lying_h.into());
            world.bed.hang_snow(&cx, &world.branches, weather.lying_mm, rounds);
            lie(&world.compiled, &step, &mut world.bed, weather.lying_h.into());
            if cx.scene.has_litter() {
                mark_covered(&cx, &mut world.leaves, &world.bed);
            }
        }
        Ok(world)
    }

    /// Counts over all leaves.
    pub fn stats(&self) -> Stats {
        let unused = self.compiled.shard_rows().unused_rows();
        Stats::of(&self.leaves, self.clock.step()).without_unused(unused)
    }

    /// Counts over the populations of particles; none in a shard that has no particles.
    pub fn particle_stats(&self) -> Vec<ParticleStats> {
        if !self.compiled.shard().is_first() {
            return Vec::new();
        }
        ParticleStats::of(self.compiled.scene(), &self.particles, &self.tallies)
    }

    /// Counts and sums over the litter; `None` without any.
    pub fn litter_stats(&self) -> Option<LitterStats> {
        let block = &self.compiled.block().litter;
        LitterStats::of(self.compiled.scene(), block, &self.leaves, &self.bed)
    }

    /// Sums over the snow; `None` without weather that brings any.
    pub fn snow_stats(&self) -> Option<SnowStats> {
        let block = self.compiled.block();
        let flakes = flakes_of(block, &self.particles)
            .iter()
            .filter(|place| particle_state(place.bits) == PARTICLE_ALIVE)
            .count();
        SnowStats::of(self.compiled.scene(), block, &self.bed, len32(flakes), self.clock.step())
    }

    /// Counts and masses of leaves that burn; `None` where none do.
    pub fn burn_stats(&self) -> Option<BurnStats> {
        BurnStats::of(
            self.compiled.scene(),
            self.compiled.block(),
            self.clock.step(),
            &self.leaves,
            &self.burns,
        )
    }

    /// All stores, in the order of checkpoints.
    pub fn stores(&self) -> Vec<&dyn Store> {
        let Self { compiled: _, clock: _, leaves, branches, bed, particles, tallies, history, burns } = self;
        vec![leaves, branches, bed, particles, tallies, history, burns]
    }

    /// Names of the columns of [`World::stores`], store by store: of leaves alone (`place`), of others after the store (`particles.place`).
    pub fn column_names(&self) -> Vec<Vec<String>> {
        let names = |store: &dyn Store| {
            let prefix =
                if store.name() == Leaves::NAME { String::new() } else { format!("{}.", store.name()) };
            store.description().iter().map(|column| format!("{prefix}{}", column.name)).collect()
        };
        self.stores().into_iter().map(names).collect()
    }

    /// All stores, to be filled.
    pub fn stores_mut(&mut self) -> Vec<&mut dyn Store> {
        let Self { compiled: _, clock: _, leaves, branches, bed, particles, tallies, history, burns } = self;
        vec![leaves, branches, bed, particles, tallies, history, burns]
    }

    /// Number of rows of each store.
    pub fn sizes(&self) -> Vec<StoreSize> {
        self.stores().into_iter().map(Store::size).collect()
    }

    /// Bytes of the stores that grow with the numbers of a scene, known before anything is built: of leaves, their burning, particles, and
    /// samples of these. Trees and heights of the ground, which have their own limits, come on top.
    pub fn counted_bytes(scene: &Scene) -> u64 {
        let rows = [
            (scene.leaf_count() as usize, Leaves::ROW_BYTES),
            (Burns::rows_of(scene), Burns::ROW_BYTES),
            (scene.particle_count() as usize, ParticleStore::ROW_BYTES),
            (HistoryStore::rows_of(scene), HistoryStore::ROW_BYTES),
        ];
        rows.iter().map(|&(rows, bytes)| rows as u64 * bytes as u64).sum()
    }

    /// Bytes of the state, over all stores.
    pub fn state_bytes(&self) -> usize {
        state_bytes(&self.stores())
    }

    /// Takes over the state and the time of a world of the same size; the compiled scene stays.
    ///
    /// # Errors
    /// [`SimError::Size`] if it is of another size.
    pub fn copy_state(&mut self, from: &Self) -> Result<(), SimError> {
        check_sizes(&self.sizes(), &from.sizes())?;
        self.clock = from.clock;
        copy_stores(&from.stores(), &mut self.stores_mut());
        Ok(())
    }

    /// Checks that this world and its scene are of the sizes of a simulator.
    ///
    /// # Errors
    /// [`SimError::Size`] for the first store that is not.
    pub fn fits(&self, simulator: &[StoreSize]) -> Result<(), SimError> {
        self.compiled.fits(simulator)?;
        check_sizes(&self.sizes(), simulator)
    }

    /// A 64-bit fingerprint of clock and stores: equal exactly when every bit of them is equal, but for one chance in
    /// 2^64. A sum over rows, so that it can be taken in any order; of a shard its share of the sum, which begins anew behind 2^64.
    pub fn state_hash(&self) -> u64 {
        self.clock_hash().wrapping_add(self.store_hash())
    }

    /// The share of the clock, which is the first shard's.
    fn clock_hash(&self) -> u64 {
        if !self.compiled.shard().is_first() {
            return 0;
        }
        let seed = mix(u64::from(self.clock.step()), self.clock.wind_travel_m().to_bits());
        let born = &self.clock.born()[..self.compiled.scene().particles.len()];
        born.iter().fold(seed, |seed, born| mix(seed, *born))
    }

    /// The share of the rows that this is the world of.
    fn store_hash(&self) -> u64 {
        let rows = self.compiled.shard_rows();
        let unused = rows.unused_rows() as usize;
        let own = |store: &dyn Store| match store.name() {
            Leaves::NAME => (unused..store.rows(), u64::from(rows.slots.start)),
            Branches::NAME => (rows.segments.clone(), rows.segments.start as u64),
            _ => (0..store.rows(), 0),
        };
        hash_stores(&self.stores(), own)
    }

    /// The block of the present step, for [`World::context`].
    pub fn step_block(&self) -> StepBlock {
        self.compiled.step_block(&self.clock)
    }

    /// The view of a kernel at the step of this block, which is made once for all leaves ([`World::step_block`]).
    pub fn context<'a>(&'a self, step: &'a StepBlock) -> Context<'a> {
        self.compiled.context(step).over(&self.bed.words)
    }
}

/// Runs of slots, each with its first.
fn runs_of(leaves: LeavesMut<'_>) -> impl Iterator<Item = (usize, LeavesMut<'_>)> {
    let mut rest = Some((0, leaves));
    std::iter::from_fn(move || {
        let (first, leaves) = rest.take().filter(|(_, leaves)| !leaves.is_empty())?;
        let count = RUN.min(leaves.len());
        let (front, back) = leaves.split_at(count);
        rest = Some((first + count, back));
        Some((first, front))
    })
}

/// Puts the leaves of a run of slots from `first` on where they are at time zero. Those before a shard's own never come to be.
fn place_leaves(
    compiled: &CompiledScene,
    cx: &Context<'_>,
    branches: &Branches,
    tables: &[Option<DropTable>],
    mut leaves: LeavesMut<'_>,
    first: usize,
) {
    let scene = compiled.scene();
    let total = scene.leaf_count();
    let mut source_first = scene.tree_leaf_count() as usize;
    let unused = (compiled.shard_rows().slots.start as usize).saturating_sub(first).min(leaves.len());
    leaves.schedule[..unused].iter_mut().for_each(|schedule| schedule.event = NEVER);
    for slot in first + unused..source_first.min(first + leaves.len()) {
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
        leaf_grow(compiled, cx, branches, tables, &mut leaves.row_mut(slot - first), slot as u32);
    }
    for (index, source) in (0..).zip(&scene.sources) {
        let lifetime = i64::from(lifetime_steps(scene, source));
        let start = source_first.max(first + unused);
        source_first += source.count as usize;
        for slot in start..source_first.min(first + leaves.len()) {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
            let place = (slot + source.count as usize - source_first) as u32;
            let mut leaf = leaves.row_mut(slot - first);
            let released = release_step(scene, source, place);
            let lives = if lifetime > 0 { (-released).max(0) / lifetime } else { 0 };
            let release = released + lives * lifetime;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "validated to fit a word"
            )]
            let word = |value: i64| value as u32;
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
            let id = slot as u32;
            if release > 0 {
                leaf.identity.id = id;
                leaf.identity.appearance = leaf_appearance(0, 0, index);
                leaf.schedule.event = word(release);
            } else {
                let id = id.wrapping_add(word(lives).wrapping_mul(total));
                leaf_release(cx, &mut leaf, id, index, word(release));
                leaf_seek_any(cx, tables, &mut leaf, word(-release));
                leaf_sample_air(cx, &mut leaf);
            }
        }
    }
}
