// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The CPU simulator.

use std::sync::atomic::AtomicU32;
use std::sync::{Arc, Mutex};

use rayon::{ThreadPool, ThreadPoolBuilder};
use windfall_core::blocks::StepBlock;
use windfall_core::device::leaf::burn::BURN_CELL_BITS;
use windfall_core::device::leaf::collide::COLLISION_CELL_BITS;
use windfall_core::particle::{ParticleStart, each_generation, steps_to_sample};
use windfall_core::tree::Forest;
use windfall_core::tree::batch::TreeBatch;
use windfall_core::{Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World};

use crate::cell_sums::CollisionCells;
use crate::exposed::ExposedLeaves;
use crate::heat_sums::HeatSums;
use crate::kernels::CHUNK;
use crate::kernels::burn_leaves::burn_leaves;
use crate::kernels::carry_forces::carry_forces;
use crate::kernels::follow_leaves::follow_leaves;
use crate::kernels::gather_heat::gather_heat;
use crate::kernels::keep_history::keep_history;
use crate::kernels::land_flakes::{Landings, land_flakes};
use crate::kernels::measure::measure;
use crate::kernels::press_snow::press_snow;
use crate::kernels::pull_particles::pull_particles;
use crate::kernels::settle_fires::settle_fires;
use crate::kernels::stack_litter::{LitterChanges, stack_litter};
use crate::kernels::step_branch_snow::step_branch_snow;
use crate::kernels::step_collisions::step_collisions;
use crate::kernels::step_leaves::{LeafSteps, step_leaves};
use crate::kernels::step_particles::step_particles;
use crate::kernels::step_snow::step_snow;
use crate::kernels::step_trees::{BatchRun, step_trees};
use crate::quiet::QuietUnits;
use crate::simd::Simd;
use crate::simd::batch_blocks::BatchBlocks;
use crate::simd::sway_scratch::Scratch;

/// Most steps that a chunk of leaves or particles goes through before the next chunk.
const MOST_FUSED: usize = 8;

/// Particles that are stepped before another thread would have woken up.
const SMALL_PARTICLES: usize = CHUNK / 4;

/// Options of the CPU simulator.
#[derive(Clone, Copy, Debug, Default)]
pub struct CpuOptions {
    /// Number of threads; one for each core when `None`.
    pub threads: Option<usize>,
    /// Instructions to use; the fastest that the processor has when `None`.
    pub simd: Option<Simd>,
}

/// Simulates on the CPU.
#[derive(Debug)]
pub struct CpuSimulator {
    world: World,
    blocks: Vec<BatchBlocks>,
    scratches: Vec<Mutex<Scratch>>,
    quiet: QuietUnits,
    exposed: ExposedLeaves,
    cells: CollisionCells,
    heat: HeatSums,
    /// Accelerations of particles by others; empty where none attract one another.
    pulls: Vec<[f32; 4]>,
    /// Places of particles that carry forces.
    carriers: Vec<[f32; 4]>,
    /// Flights of particles at the start of the step; empty where none go along with others.
    starts: Vec<ParticleStart>,
    /// None where threads cannot be started: there the caller's does everything.
    pool: Option<ThreadPool>,
    simd: Simd,
}

impl CpuSimulator {
    /// A simulator that owns a copy of the world.
    ///
    /// # Errors
    /// [`SimError::Device`] if the threads cannot be started.
    pub fn new(world: &World, options: CpuOptions) -> Result<Self, SimError> {
        let pool = if cfg!(target_family = "wasm") {
            None
        } else {
            let builder = ThreadPoolBuilder::new().num_threads(options.threads.unwrap_or(0));
            Some(builder.build().map_err(|error| SimError::Device { reason: error.to_string() })?)
        };
        let simd = options.simd.unwrap_or_else(Simd::best);
        let quiet = QuietUnits::new(world.compiled.shard_rows().first_row, world.leaves.len());
        let exposed = ExposedLeaves::new(world.leaves.len());
        let (world, blocks, scratches) = (world.clone(), Vec::new(), Vec::new());
        let (cells, heat) = (CollisionCells::default(), HeatSums::default());
        let (pulls, carriers, starts) = (Vec::new(), Vec::new(), Vec::new());
        let mut simulator = Self {
            world,
            blocks,
            scratches,
            quiet,
            exposed,
            cells,
            heat,
            pulls,
            carriers,
            starts,
            pool,
            simd,
        };
        let forest = Arc::clone(simulator.world.compiled.forest());
        simulator.plant(&forest);
        Ok(simulator)
    }

    /// The world as it is now.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Makes room for the trees.
    fn plant(&mut self, forest: &Forest) {
        let rows = forest.batches().iter().map(TreeBatch::len).max().unwrap_or(0);
        let most = forest.batches().iter().map(|batch| batch.blocks.len()).max().unwrap_or(0);
        let of_batch = |batch: &TreeBatch| {
            let first = batch.first as usize;
            BatchBlocks::new(batch, &forest.segments()[first..first + batch.len()], most)
        };
        self.blocks = forest.batches().iter().map(of_batch).collect();
        let twigs = self.blocks.iter().map(|blocks| blocks.twigs.len()).max().unwrap_or(0);
        let scratch = |_| Mutex::new(Scratch::new(rows, most, twigs));
        self.scratches = (0..self.threads()).map(scratch).collect();
    }

    /// Number of threads.
    fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }
}

impl Simulator for CpuSimulator {
    fn info(&self) -> SimulatorInfo {
        let threads = self.threads();
        SimulatorInfo {
            backend: "cpu",
            adapter: format!("{threads} thread{}", if threads == 1 { "" } else { "s" }),
            contract: Contract::Exact,
            sizes: self.world.sizes(),
        }
    }

    fn clock(&self) -> Clock {
        self.world.clock
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        world.fits(&self.world.sizes())?;
        self.set_scene(&world.compiled)?;
        self.world.copy_state(world)
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        world.fits(&self.world.sizes())?;
        world.copy_state(&self.world)
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        compiled.fits(&self.world.sizes())?;
        if !Arc::ptr_eq(self.world.compiled.forest(), compiled.forest()) {
            self.plant(compiled.forest());
        }
        self.world.compiled = compiled.clone();
        self.quiet.forget();
        self.exposed.forget();
        Ok(())
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        let World { compiled, clock, leaves, branches, bed, particles, tallies, history, burns } =
            &mut self.world;
        let (simd, blocks, scratches, quiet) = (self.simd, &self.blocks, &self.scratches, &self.quiet);
        let (has_litter, has_snow) = (compiled.block().has_litter(), compiled.block().has_snow());
        let (changes, exposed) = (LitterChanges::default(), &self.exposed);
        if compiled.block().has_living_litter() {
            self.cells.make(1 << COLLISION_CELL_BITS);
        }
        if compiled.block().leaves_burn() {
            self.heat.cells.make(1 << BURN_CELL_BITS);
        }
        let heat = &self.heat;
        let landings: [Landings; MOST_FUSED] = Default::default();
        let (cells, pulls, carriers) = (&self.cells, &mut self.pulls, &mut self.carriers);
        let starts = &mut self.starts;
        starts.resize(compiled.start_count(), bytemuck::Zeroable::zeroed());
        let (is_mutual, has_nests) = (compiled.has_mutual(), compiled.block().has_nests());
        let has_carriers = !compiled.carriers().is_empty();
        let forest = Arc::clone(compiled.forest());
        let is_small =
            leaves.len() <= CHUNK && forest.len() <= CHUNK / 16 && particles.len() <= SMALL_PARTICLES;
        let sums: Vec<AtomicU32> = tallies.count.iter().map(|&count| AtomicU32::new(count)).collect();
        let last = clock.step().saturating_add(count).saturating_sub(1);
        if forest.is_empty() && particles.is_empty() && !has_litter && !has_snow && quiet.are_all_quiet(last)
        {
            (0..count).for_each(|_| compiled.advance(clock));
            return Ok(());
        }
        let shard = compiled.shard_rows();
        let unused = shard.unused_rows() as usize;
        let tree_leaves = shard.rows_on_trees(compiled.block().tree_leaf_count) as usize;
        // Leaves of trees, in whole chunks, follow the segments step by step.
        let carried =
            if forest.is_empty() { 0 } else { tree_leaves.next_multiple_of(CHUNK).min(leaves.len()) };
        let (quiet_trees, quiet_free) = quiet.split_at(carried);
        let mut run = |most: usize| {
            // Samples of ways are taken behind the last step of a portion.
            let sampled =
                steps_to_sample(compiled.histories(), clock.step()).map_or(most, |steps| steps as usize);
            let count = most.min(sampled);
            let mut step_blocks = [<StepBlock as bytemuck::Zeroable>::zeroed(); MOST_FUSED];
            for block in &mut step_blocks[..count] {
                *block = compiled.step_block(clock);
                compiled.advance(clock);
            }
            let steps = step_blocks.each_ref().map(|block| compiled.context(block).over(&bed.words));
            if has_carriers {
                carry_forces(&steps[0], compiled.carriers(), particles, carriers);
            }
            let steps = steps.map(|cx| cx.with_carriers(carriers));
            let steps = &steps[..count];
            if is_mutual && let [cx] = steps {
                pulls.resize(particles.len(), [0.0; 4]);
                pull_particles(cx, particles, pulls, simd);
            }
            each_generation(&compiled.block().populations, particles, starts, |generation| {
                step_particles(steps, generation, pulls, &sums, &landings, simd);
            });
            if let Some(cx) = steps.last() {
                keep_history(cx, compiled.histories(), particles, history);
            }
            // With litter it is one step.
            if let [cx] = steps
                && cx.scene.collides(cx.step.index)
            {
                step_collisions(cx, leaves, quiet.units(), cells);
            }
            let heating = steps.first().filter(|cx| cx.scene.heats(cx.step.index));
            if let Some(cx) = heating {
                gather_heat(cx, leaves, burns, heat);
                burn_leaves(cx, leaves.as_mut(), burns.as_mut(), 0, heat, &changes);
            }
            let heats = heating.is_some();
            let of = |steps| LeafSteps { steps, changes: &changes, exposed, simd };
            if !forest.is_empty() {
                for cx in steps {
                    step_trees(
                        cx,
                        BatchRun {
                            batches: forest.batches(),
                            blocks,
                            segments: &forest.segments()[shard.segments.clone()],
                            branches: branches
                                .as_mut()
                                .split_at(shard.segments.end)
                                .0
                                .split_at(shard.segments.start)
                                .1,
                            leaves: leaves.as_mut().split_at(tree_leaves).0.split_at(unused).1,
                            quiet,
                        },
                        scratches,
                        simd,
                    );
                    let on_trees = leaves.as_mut().split_at(carried).0;
                    step_leaves(&of(std::slice::from_ref(cx)), on_trees, quiet_trees, 0);
                }
            }
            let free = leaves.as_mut().split_at(carried).1;
            step_leaves(&of(steps), free, quiet_free, carried);
            if has_litter {
                let bare = compiled.context(&step_blocks[0]);
                stack_litter(&bare, &mut leaves.as_mut(), bed, quiet, exposed, &changes);
                if heats {
                    settle_fires(bare.scene, bed, heat);
                }
                follow_leaves(&bare, leaves, burns, particles);
            }
            if has_snow {
                for (block, landings) in step_blocks[..count].iter().zip(&landings) {
                    let cx = compiled.context(block);
                    land_flakes(&cx, landings, particles, bed);
                    step_branch_snow(&cx, branches, bed);
                    step_snow(&cx, bed, simd);
                    press_snow(&cx, bed);
                }
            }
            count
        };
        let mut steps = || {
            let mut left = count as usize;
            while left > 0 {
                // Leaves see what others have left in the litter a step before, branches what snow they bear, and particles where others are, or what befell them.
                let is_borne = has_snow && !forest.is_empty();
                let sees_others = has_litter || is_borne || is_mutual || has_nests || has_carriers;
                let portion = left.min(if sees_others { 1 } else { MOST_FUSED });
                left -= run(portion);
            }
        };
        // A small world is done before another thread would have woken up.
        match &self.pool {
            Some(pool) if !is_small => pool.install(steps),
            _ => steps(),
        }
        tallies.count = sums.into_iter().map(AtomicU32::into_inner).collect();
        Ok(())
    }

    fn sync(&mut self) -> Result<(), SimError> {
        Ok(())
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        let places = &self.world.leaves.place;
        let counters = match &self.pool {
            Some(pool) => pool.install(|| measure(places)),
            None => measure(places),
        };
        let unused = self.world.compiled.shard_rows().unused_rows();
        Ok(Stats::from_counters(&counters, self.world.clock.step()).without_unused(unused))
    }
}
