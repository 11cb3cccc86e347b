// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The wgpu simulator.

mod pages;
mod requests;
mod snow;
mod steps;

use std::sync::Arc;

use windfall_core::blocks::{SceneBlock, StepBlock};
use windfall_core::layout::Uint4;
use windfall_core::stats::COUNTER_COUNT;
use windfall_core::{Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World};

use self::pages::{HeatSums, List, Page};
pub use self::requests::{StateRequest, StatsRequest};
use self::snow::SnowBindings;
use self::steps::STEPS_PER_PASS;
use crate::buffers::{buffer, group, table};
use crate::columns::{WorldBuffers, WorldColumns};
use crate::forest::ForestBuffers;
use crate::gpu::{Gpu, describe_adapter};
use crate::kernel_id::KernelId;
use crate::particles::ParticleBindings;
use crate::pipelines::{GroupLayout, Pipelines};
use crate::prelude::{MAX_GROUPS, WORKGROUP_SIZE};
use crate::shaders::Shaders;

/// Bytes of the largest record of a leaf column.
const LARGEST_RECORD: u64 = 16;
/// Leaves per page are a multiple of this, which keeps windows aligned on any device.
const PAGE_STEP: u32 = 4096;

/// Options of the wgpu simulator.
#[derive(Clone, Debug, Default)]
pub struct WgpuOptions {
    /// Contract to keep; the closest that the device can when `None`.
    pub contract: Option<Contract>,
    /// Most leaves or particles in one binding; what the device's bindings and dispatches allow when `None`. For testing the paging of large worlds.
    pub page_leaves: Option<u32>,
    /// Other shaders than the project's own, for tests that must notice the difference.
    pub shaders: Option<Shaders>,
}

/// Simulates on a GPU.
#[derive(Debug)]
pub struct WgpuSimulator {
    gpu: Gpu,
    contract: Contract,
    pipelines: Pipelines,
    compiled: CompiledScene,
    clock: Clock,
    buffers: WorldBuffers,
    page_leaves: u32,
    scene_buffer: wgpu::Buffer,
    step_buffer: wgpu::Buffer,
    step_stride: u32,
    tables: (Arc<[Uint4]>, wgpu::Buffer),
    forest: Option<ForestBuffers>,
    particles: Option<ParticleBindings>,
    counters: wgpu::Buffer,
    counters_group: wgpu::BindGroup,
    pages: Vec<Page>,
    /// Cells of the air in which leaves collide with each other; clear between steps.
    collisions: Option<List>,
    heat: Option<HeatSums>,
    snow: Option<SnowBindings>,
    /// Steps for which the lists of active leaves still hold.
    listed_steps: u32,
}

impl WgpuSimulator {
    /// A simulator with a copy of the world on the device.
    ///
    /// # Errors
    /// [`SimError::Capacity`] if the device cannot hold the leaves; a device that refuses or is lost.
    pub fn new(gpu: &Gpu, world: &World, options: &WgpuOptions) -> Result<Self, SimError> {
        gpu.scoped(|| Self::on_device(gpu, world, options))?
    }

    /// Makes a simulator inside error scopes.
    fn on_device(gpu: &Gpu, world: &World, options: &WgpuOptions) -> Result<Self, SimError> {
        let contract = options.contract.unwrap_or(gpu.contract());
        let shaders = options.shaders.clone().unwrap_or_default();
        let compiled = world.compiled.clone();
        let mut pipelines = Pipelines::new(gpu, shaders, contract)?;
        pipelines.prepare(gpu, KernelId::needed(&compiled))?;
        let mut buffers = WorldBuffers::new(gpu, world)?;
        let limits = gpu.device().limits();
        let binding = limits.max_storage_buffer_binding_size / LARGEST_RECORD;
        let largest = u32::try_from(binding).unwrap_or(u32::MAX).min(MAX_GROUPS * WORKGROUP_SIZE);
        let largest = largest.min(options.page_leaves.unwrap_or(u32::MAX));
        let step_stride = u32::try_from(size_of::<StepBlock>())
            .expect("a step block is small")
            .next_multiple_of(limits.min_uniform_buffer_offset_alignment);
        let uniform = |label, size| buffer(gpu, label, size, wgpu::BufferUsages::UNIFORM);
        let tables = table(gpu, compiled.tables(), buffers.bed_bytes())?;
        buffers.keep_bed_in(&tables.1, bed_offset(&compiled));
        let counters = buffer(
            gpu,
            "counters",
            u64::from(COUNTER_COUNT) * 4,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let counters_group =
            group(gpu, pipelines.layout(GroupLayout::WrittenBuffer), [counters.as_entire_binding()]);
        let mut simulator = Self {
            gpu: gpu.clone(),
            contract,
            pipelines,
            compiled,
            clock: world.clock,
            buffers,
            page_leaves: (largest / PAGE_STEP).max(1) * PAGE_STEP,
            scene_buffer: uniform("scene", size_of::<SceneBlock>() as u64),
            step_buffer: uniform("step", u64::from(STEPS_PER_PASS * step_stride)),
            step_stride,
            tables,
            forest: None,
            particles: None,
            counters,
            counters_group,
            pages: Vec::new(),
            collisions: None,
            heat: None,
            snow: None,
            listed_steps: 0,
        };
        simulator.plant();
        simulator.make_heat_sums();
        simulator.bind_pages();
        simulator.bind_particles()?;
        simulator.bind_snow();
        simulator.make_collision_cells();
        simulator.write_state(world)?;
        Ok(simulator)
    }

    /// The columns as buffers, to be drawn on the same device without a copy. They hold the state after all submitted
    /// steps, and are not to be written: a step passes by leaves that nothing of its own can move.
    pub fn columns(&self) -> WorldColumns<'_> {
        self.buffers.columns()
    }

    /// Number of windows the columns are bound in.
    pub fn page_count(&self) -> usize {
        self.pages.len()
    }

    /// Makes room for the trees of the scene; trees that are there already go on as they stand.
    fn plant(&mut self) {
        let forest = self.compiled.forest();
        if !forest.is_empty() {
            let (blocks, branches) = (self.shared_blocks(), self.buffers.branches());
            self.forest = Some(ForestBuffers::new(&self.gpu, &self.pipelines, forest, blocks, branches));
        }
    }

    /// Binds the columns of the particles.
    fn bind_particles(&mut self) -> Result<(), SimError> {
        let blocks = self.shared_blocks();
        self.particles = ParticleBindings::new(
            &self.gpu,
            &self.pipelines,
            &self.compiled,
            blocks,
            &self.buffers,
            self.page_leaves,
        )?;
        Ok(())
    }

    /// Bind group that every kernel sees first: blocks and tables.
    fn shared_blocks(&self) -> [wgpu::BindingResource<'_>; 3] {
        [self.scene_buffer.as_entire_binding(), self.step_binding(), self.tables.1.as_entire_binding()]
    }

    /// The block of one step; its place among the steps of a submission is a dynamic offset.
    fn step_binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.step_buffer,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<StepBlock>() as u64),
        })
    }

    /// Makes tables of another length, and moves the bed of litter behind them.
    fn move_tables(&mut self, former: &CompiledScene) -> Result<(), SimError> {
        let bytes = self.buffers.bed_bytes();
        let tables = table(&self.gpu, self.compiled.tables(), bytes)?;
        let to = bed_offset(&self.compiled);
        if bytes > 0 {
            let mut encoder =
                self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.copy_buffer_to_buffer(&self.tables.1, bed_offset(former), &tables.1, to, bytes);
            self.gpu.queue().submit([encoder.finish()]);
        }
        self.buffers.keep_bed_in(&tables.1, to);
        self.tables = tables;
        Ok(())
    }

    /// Replaces the scene by one of the same sizes.
    fn take_over(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        self.pipelines.prepare(&self.gpu, KernelId::needed(compiled))?;
        self.gpu.queue().write_buffer(&self.scene_buffer, 0, bytemuck::bytes_of(compiled.block()));
        let mut moved = false;
        let is_replanted = !Arc::ptr_eq(self.compiled.forest(), compiled.forest());
        let former = std::mem::replace(&mut self.compiled, compiled.clone());
        self.listed_steps = 0;
        if !Arc::ptr_eq(&self.tables.0, compiled.tables()) {
            moved = self.tables.0.len() != compiled.tables().len();
            if moved {
                self.move_tables(&former)?;
            } else {
                self.tables.0 = Arc::clone(compiled.tables());
                self.gpu.queue().write_buffer(&self.tables.1, 0, bytemuck::cast_slice(&self.tables.0));
            }
        }
        if is_replanted {
            self.plant();
        } else if let Some(mut forest) = self.forest.take() {
            forest.rebind(&self.gpu, &self.pipelines, self.shared_blocks());
            self.forest = Some(forest);
        }
        if moved {
            self.make_heat_sums();
        }
        if moved || is_replanted || former.block().populations != compiled.block().populations {
            self.bind_pages();
        }
        if moved || former.block().populations != compiled.block().populations {
            self.bind_particles()?;
            self.bind_snow();
        }
        self.make_collision_cells();
        Ok(())
    }
}

/// Bytes of the tables of a scene, behind which its bed of litter lies.
fn bed_offset(compiled: &CompiledScene) -> u64 {
    u64::from(compiled.block().litter.first_row) * size_of::<Uint4>() as u64
}

impl Simulator for WgpuSimulator {
    fn info(&self) -> SimulatorInfo {
        SimulatorInfo {
            backend: "wgpu",
            adapter: describe_adapter(self.gpu.info()),
            contract: self.contract,
            sizes: self.buffers.sizes(),
        }
    }

    fn clock(&self) -> Clock {
        self.clock
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        world.fits(&self.buffers.sizes())?;
        self.listed_steps = 0;
        self.buffers.write(&self.gpu, world)?;
        self.clock = world.clock;
        self.set_scene(&world.compiled)?;
        self.gpu.scoped(|| self.clear_events())
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        world.fits(&self.buffers.sizes())?;
        world.clock = self.clock;
        self.buffers.read(&self.gpu, world)
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        compiled.fits(&self.buffers.sizes())?;
        let gpu = self.gpu.clone();
        gpu.scoped(|| self.take_over(compiled))?
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        self.step_timed(count, None)
    }

    fn sync(&mut self) -> Result<(), SimError> {
        self.gpu.wait()
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        let request = self.request_stats()?;
        request.wait()
    }
}
