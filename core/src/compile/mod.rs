// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a scene into the blocks and tables that kernels read. Long, since compiling and retuning go through the same parts in the same order.

mod births;
mod block;
mod body;
mod burn;
mod cycle;
mod field;
mod foliage;
mod force_carriers;
mod forces;
mod jet;
mod nest;
mod occupancy;
mod particles;
mod plume;
mod shard;
mod shelter;
mod slipstream;
mod snow;
mod solids;
mod source;
mod species;
mod step;
mod tables;
mod vortex;
mod water;
mod wind;

use std::sync::Arc;

pub(crate) use self::births::Births;
pub use self::block::{NO_WATER_M, REST_OFFSET_M};
use self::block::{compile_block, retune_block};
pub use self::cycle::Cycle;
use self::cycle::firm;
pub(crate) use self::foliage::leaf_site;
use self::foliage::{foliage_of, petiole_rows, seedlings, shed_rows};
use self::force_carriers::force_carriers;
use self::particles::populations_of;
pub use self::shard::{Shard, ShardRows};
use self::shelter::{is_sheltered, shelter_inputs, shelter_rows};
pub use self::snow::OpenSnow;
use self::snow::snow_block;
use self::solids::Solids;
pub(crate) use self::source::{lifetime_steps, release_step};
use self::tables::{motions_of, pack_motion};
use crate::arith::rng::seed_words;
use crate::blocks::{SceneBlock, StepBlock};
use crate::clock::Clock;
use crate::context::Context;
use crate::convert::len32;
use crate::device::motion::lookup::MotionRows;
use crate::device::particle::force_carrier::CarrierRun;
use crate::device::particle::record::{POPULATION_LOCAL, POPULATION_MUTUAL};
use crate::device::terrain::ground::ground_relief;
use crate::device::wind::gust::{GUST_ROWS, GUST_SPACING, gust_rows};
use crate::device::wind::profile::profile_rows;
use crate::device::wind::turbulence::{TURBULENCE_X, turbulence_rows};
use crate::error::{SceneError, SimError};
use crate::layout::Uint4;
use crate::leaf::{Burns, Leaves};
use crate::litter::Bed;
use crate::particle::{HistoryRun, HistoryStore, ParticleStore, TallyStore, history_runs};
use crate::scene::Scene;
use crate::solid::Solid;
use crate::store::{StoreSize, check_sizes};
use crate::terrain::Hills;
use crate::threads::both;
use crate::tree::{Branches, Forest};
use crate::wind::{ShelterGrids, turbulence_box};

/// A compiled scene: uniform block and tables, ready for any backend.
#[derive(Clone, Debug)]
pub struct CompiledScene {
    scene: Scene,
    block: SceneBlock,
    tables: Arc<[Uint4]>,
    forest: Arc<Forest>,
    solids: Arc<Solids>,
    births: Arc<Births>,
    carriers: Arc<[CarrierRun]>,
    histories: Arc<[(usize, HistoryRun)]>,
    cycle: Option<Cycle>,
    shard: Shard,
    shard_rows: ShardRows,
}

impl CompiledScene {
    /// Compiles a validated scene. Motion tables and meshes that are files are read now.
    ///
    /// # Errors
    /// A motion table or a mesh that cannot be read or used, a tree that does not grow.
    pub fn compile(scene: &Scene) -> Result<Self, SceneError> {
        Self::compile_as(scene, None, Shard::WHOLE)
    }

    /// Compiles a shard of a scene.
    ///
    /// # Errors
    /// As [`CompiledScene::compile`]; what leaves of all shards would share, named by its field.
    pub fn compile_shard(scene: &Scene, shard: Shard) -> Result<Self, SceneError> {
        shard.check(scene)?;
        Self::compile_as(scene, None, shard)
    }

    /// Compiles a scene as [`CompiledScene::compile`] does; one that [`Cycle::of`] made together with its cycle.
    ///
    /// # Errors
    /// As there.
    pub fn compile_with(scene: &Scene, cycle: Option<Cycle>) -> Result<Self, SceneError> {
        Self::compile_as(scene, cycle, Shard::WHOLE)
    }

    fn compile_as(scene: &Scene, cycle: Option<Cycle>, shard: Shard) -> Result<Self, SceneError> {
        let seed = seed_words(scene.seed);
        let gusts = cycle.as_ref().map_or(GUST_ROWS / GUST_SPACING, Cycle::gusts);
        let cells = cycle.as_ref().map_or(TURBULENCE_X, Cycle::cell_period);
        let (turbulence, motions) =
            both(|| turbulence_rows(&turbulence_box(seed, cells)), || motions_of(scene, seed));
        let motions = motions?;
        let mut tables = profile_rows_of(scene);
        tables.extend(gust_rows(seed, gusts));
        tables.extend(turbulence);
        let mut solids = Solids::of(scene)?;
        let mut block = compile_block(scene, &motions, solids.own());
        block.first_hill_row = len32(tables.len());
        tables.extend(scene.ground.terrain.iter().flat_map(|terrain| Hills::grow(terrain).rows()));
        let kinds = foliage_of(scene);
        let mut chances = shed_rows(scene, &kinds);
        if let Some(cycle) = &cycle {
            firm(&mut chances);
            // A slot's next leaf is its last one again.
            block.ids_per_life = 0;
            block.flutter_per_step = cycle.flutter(scene.dt_s);
        }
        let seedlings = seedlings(scene, solids.own(), |x, z| foot_height(&block, &tables, x, z))?;
        let mut forest = Forest::plant(seedlings, scene.gravity_m_s2);
        solids.add_trunks(scene, &forest);
        let shelter = ShelterGrids::of(scene, solids.own(), &forest);
        if let Some(grids) = &shelter {
            let rows = shelter_rows(grids, scene, solids.own(), &forest, &block, &tables);
            [block.shelter, block.near_shelter] = grids.blocks(len32(tables.len()));
            if is_sheltered(scene, &rows) {
                block.shelter.lack_unit = grids.lack_unit();
            }
            tables.extend(rows);
        }
        let first_row = len32(tables.len());
        let dry_m = |x_m, z_m| dry_height(&block, &tables, x_m, z_m);
        let (snow, cells) =
            snow_block(scene, &block, solids.own(), &forest, shelter.as_ref(), first_row, dry_m);
        block.snow = snow;
        tables.extend(cells);
        block.first_shed_row = len32(tables.len());
        tables.extend(chances);
        block.first_petiole_row = len32(tables.len());
        tables.extend(petiole_rows(scene, &forest, &kinds));
        let shard_rows = ShardRows::of(shard, scene, &forest);
        forest.keep(shard_rows.batches.clone());
        block.solids = solids.tabulate(scene, &block, &mut tables);
        let births = Births::of(scene, seed, cycle.as_ref());
        let (carriers, points) = force_carriers(scene, len32(tables.len()));
        tables.extend(points);
        let (populations, forces) = populations_of(scene, &carriers, len32(tables.len()), births.lead());
        if shard.is_first() {
            block.populations = populations;
        }
        tables.extend(forces);
        block.first_motion_row = len32(tables.len());
        tables.extend(pack_motion(scene, &motions, block.table_species));
        block.litter.first_row = len32(tables.len());
        Ok(Self {
            scene: scene.clone(),
            block,
            tables: tables.into(),
            forest: forest.into(),
            solids: solids.into(),
            histories: if shard.is_first() { history_runs(scene).into() } else { Arc::default() },
            births: births.into(),
            carriers: carriers.into_iter().filter(|run| shard.is_first() && run.count != 0).collect(),
            cycle,
            shard,
            shard_rows,
        })
    }

    /// The same scene with another wind, season, ground, fall and rotation speed; species, sources, trees, particles, weather, hills, litter but for how
    /// it rubs, sticks, bounces and tilts, solid things, seed, step length and gravity stay. Much cheaper than compiling anew.
    pub fn retune(&mut self, scene: &Scene) {
        let keep_trees = (self.scene.trees.clone(), self.scene.tree_kinds.clone());
        let keep = (self.scene.species.clone(), self.scene.sources.clone(), self.scene.seed, self.scene.dt_s);
        if self.scene.wind.profile != scene.wind.profile
            || self.scene.wind.reference_height_m != scene.wind.reference_height_m
            || self.scene.ground.surface_roughness_m != scene.ground.surface_roughness_m
        {
            let rows = profile_rows_of(scene);
            self.replace_rows(self.block.wind.first_profile_row, &rows);
        }
        let autumn = self.scene.autumn;
        let inputs = shelter_inputs(&self.scene);
        let (terrain, gravity_m_s2) = (self.scene.ground.terrain, self.scene.gravity_m_s2);
        let litter = self.scene.ground.litter.map(|kept| kept.retuned(scene.ground.litter));
        let solid = (self.scene.objects.clone(), self.scene.walkers.clone());
        let particles = (self.scene.particles.clone(), self.scene.forces.clone());
        let weather = self.scene.weather.clone();
        self.scene = scene.clone();
        (self.scene.species, self.scene.sources, self.scene.seed, self.scene.dt_s) = keep;
        (self.scene.trees, self.scene.tree_kinds) = keep_trees;
        (self.scene.ground.terrain, self.scene.gravity_m_s2) = (terrain, gravity_m_s2);
        self.scene.ground.litter = litter;
        (self.scene.objects, self.scene.walkers) = solid;
        (self.scene.particles, self.scene.forces) = particles;
        self.scene.weather = weather;
        if self.scene.autumn != autumn {
            let rows = shed_rows(&self.scene, &foliage_of(&self.scene));
            self.replace_rows(self.block.first_shed_row, &rows);
        }
        retune_block(&self.scene, self.solids.own(), &mut self.block);
        let shelter = ShelterGrids::of(&self.scene, self.solids.own(), &self.forest);
        if shelter_inputs(&self.scene) != inputs && self.block.has_snow() {
            let first_row = self.block.snow.first_row;
            let dry_m = |x_m, z_m| dry_height(&self.block, &self.tables, x_m, z_m);
            let (solids, forest) = (self.solids.own(), &self.forest);
            let (_, rows) =
                snow_block(&self.scene, &self.block, solids, forest, shelter.as_ref(), first_row, dry_m);
            self.replace_rows(first_row, &rows);
        }
        if let Some(grids) = shelter {
            if shelter_inputs(&self.scene) != inputs {
                let (solids, block) = (self.solids.own(), &self.block);
                let rows = shelter_rows(&grids, &self.scene, solids, &self.forest, block, &self.tables);
                self.replace_rows(self.block.shelter.first_row, &rows);
            }
            let rows = &self.tables[self.block.shelter.first_row as usize..][..grids.row_count()];
            self.block.shelter.lack_unit =
                if is_sheltered(&self.scene, rows) { grids.lack_unit() } else { 0.0 };
        }
    }

    /// Puts other rows in the place of those from `first` on.
    fn replace_rows(&mut self, first: u32, rows: &[Uint4]) {
        let mut tables = self.tables.to_vec();
        tables[first as usize..][..rows.len()].copy_from_slice(rows);
        self.tables = tables.into();
    }

    /// Number of rows of each store of a world of this scene, in the order of [`World::stores`](crate::World::stores).
    pub fn sizes(&self) -> Vec<StoreSize> {
        // Particles are not divided.
        let of_first = |rows: usize| if self.shard.is_first() { rows } else { 0 };
        vec![
            StoreSize { store: Leaves::NAME, rows: self.shard_rows.leaf_rows() as usize },
            StoreSize { store: Branches::NAME, rows: self.forest.len() },
            StoreSize { store: Bed::NAME, rows: Bed::rows_of(&self.block) },
            StoreSize { store: ParticleStore::NAME, rows: of_first(self.scene.particle_count() as usize) },
            StoreSize { store: TallyStore::NAME, rows: of_first(TallyStore::rows_of(&self.scene)) },
            StoreSize { store: HistoryStore::NAME, rows: of_first(HistoryStore::rows_of(&self.scene)) },
            StoreSize { store: Burns::NAME, rows: Burns::rows_of(&self.scene) },
        ]
    }

    /// The part of the scene that this is.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// The leaves and trees of that part.
    pub fn shard_rows(&self) -> &ShardRows {
        &self.shard_rows
    }

    /// Bytes of all stores of a world of this scene.
    pub(crate) fn state_bytes(&self) -> u64 {
        let row_bytes = [
            Leaves::ROW_BYTES,
            Branches::ROW_BYTES,
            Bed::ROW_BYTES,
            ParticleStore::ROW_BYTES,
            TallyStore::ROW_BYTES,
            HistoryStore::ROW_BYTES,
            Burns::ROW_BYTES,
        ];
        self.sizes().iter().zip(row_bytes).map(|(size, bytes)| size.rows as u64 * bytes as u64).sum()
    }

    /// Checks that a simulator with stores of these sizes can go on with this scene.
    ///
    /// # Errors
    /// [`SimError::Size`] for the first store that would have another number of rows.
    pub fn fits(&self, simulator: &[StoreSize]) -> Result<(), SimError> {
        check_sizes(&self.sizes(), simulator)
    }

    /// The scene this was compiled from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The uniform block.
    pub fn block(&self) -> &SceneBlock {
        &self.block
    }

    /// Returns true if particles of some population attract one another, be it by nothing.
    pub fn has_mutual(&self) -> bool {
        self.block.populations.iter().any(|population| (population.flags & POPULATION_MUTUAL) != 0)
    }

    /// All tables as rows of four words, one after another: the wind's profile, gusts and turbulence; hills; shelter; chances of
    /// petioles to break ([`SHED_ROWS`](crate::device::leaf::petiole::SHED_ROWS) for each kind of trees); petioles; solid parts; forces on particles;
    /// motion (see [`MotionRows`]). The block holds the first row of each.
    pub fn tables(&self) -> &Arc<[Uint4]> {
        &self.tables
    }

    /// The trees.
    pub fn forest(&self) -> &Arc<Forest> {
        &self.forest
    }

    /// The solid parts of the scene: objects in their order, then the limbs of walkers.
    pub fn solids(&self) -> &[Solid] {
        self.solids.own()
    }

    /// The view of a kernel in one step.
    pub fn context<'a>(&'a self, step: &'a StepBlock) -> Context<'a> {
        Context {
            scene: &self.block,
            step,
            motion: MotionRows::new(&self.tables[self.block.first_motion_row as usize..]),
            tables: &self.tables,
            litter: &[],
            carriers: &[],
        }
    }

    /// Height of the ground at a place in metres, whatever the water above it.
    pub fn ground_height(&self, x_m: f32, z_m: f32) -> f32 {
        foot_height(&self.block, &self.tables, x_m, z_m)
    }

    /// A step in which snow lies for so many seconds in the wind and the air of another, as one of many rounds.
    pub(crate) fn lying_step(&self, of: &StepBlock, round: u32, seconds: f64) -> StepBlock {
        snow::lying_step(&self.scene, &self.block, &self.tables, of, round, seconds)
    }

    /// Snow that the weather alone leaves in the open at a time in seconds; `None` without weather.
    pub fn open_snow(&self, time_s: f64) -> Option<OpenSnow> {
        self.scene.weather.as_ref().map(|weather| snow::open_snow(weather, time_s))
    }

    /// Number of flights at the start of a step that particles need which go along with others: one for each particle, or none.
    pub fn start_count(&self) -> usize {
        let flags = self.block.populations.iter().fold(0, |flags, population| flags | population.flags);
        if (flags & POPULATION_LOCAL) == 0 { 0 } else { self.scene.particle_count() as usize }
    }

    /// Forces that particles carry.
    pub fn carriers(&self) -> &[CarrierRun] {
        &self.carriers
    }

    /// Runs of particles of whose ways samples are kept, each with the number of its population.
    pub fn histories(&self) -> &[(usize, HistoryRun)] {
        &self.histories
    }

    /// Births of particles.
    pub(crate) fn births(&self) -> &Births {
        &self.births
    }

    /// Moves a clock on by one step.
    pub fn advance(&self, clock: &mut Clock) {
        clock.advance(self.wind_travel_per_step_m(), self.births.in_step(clock.step()));
    }

    /// Distance in metres that the mean wind travels in one step.
    pub fn wind_travel_per_step_m(&self) -> f64 {
        f64::from(self.block.wind.mean_speed_m_s) * f64::from(self.scene.dt_s)
    }
}

/// Rows of the wind's profile over the ground of a scene.
fn profile_rows_of(scene: &Scene) -> Vec<Uint4> {
    profile_rows(scene.wind.profile, scene.wind.reference_height_m, scene.ground.surface_roughness_m)
}

/// Height of the ground in metres, whatever the water above it.
fn foot_height(block: &SceneBlock, tables: &[Uint4], x_m: f32, z_m: f32) -> f32 {
    let step = bytemuck::Zeroable::zeroed();
    let cx = Context {
        scene: block,
        step: &step,
        motion: MotionRows::new(&[]),
        tables,
        litter: &[],
        carriers: &[],
    };
    let relief = if block.has_terrain() { ground_relief(&cx, x_m, z_m) } else { 0.0 };
    block.ground_height_m + relief
}

/// Height of the ground in metres where no water stands on it.
fn dry_height(block: &SceneBlock, tables: &[Uint4], x_m: f32, z_m: f32) -> Option<f32> {
    let height_m = foot_height(block, tables, x_m, z_m);
    let water_m = if block.has_terrain() {
        block.ground_height_m + block.water_relief_m
    } else {
        block.surface_height_m
    };
    (height_m >= water_m).then_some(height_m)
}
