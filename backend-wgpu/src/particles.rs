// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The particles of a world on the device, in windows that fit in one binding each: pages, and for those that are born of others the slots
//! from the first parent to the last child.

use std::ops::Range;

use windfall_core::blocks::PopulationBlock;
use windfall_core::device::particle::force_carrier::CARRIER_ROWS;
use windfall_core::device::particle::history::history_is_due;
use windfall_core::device::particle::record::POPULATION_MUTUAL;
use windfall_core::particle::{CarrierRun, HistoryRun, ParticlePlace, ParticleRun, ParticleStart};
use windfall_core::{CompiledScene, SimError};

use crate::buffers::{buffer, group, uniform};
use crate::columns::WorldBuffers;
use crate::gpu::{Gpu, describe_adapter};
use crate::pipelines::{GroupLayout, Pipelines};
use crate::prelude::WORKGROUP_SIZE;

/// Bytes of the block of a run.
#[expect(clippy::cast_possible_truncation, reason = "a few words")]
const RUN_BYTES: u32 = size_of::<ParticleRun>() as u32;

/// Bytes of the flight of a particle at the start of a step.
const START_BYTES: u64 = size_of::<ParticleStart>() as u64;

/// Bindings of the particles of a world.
#[derive(Debug)]
pub(crate) struct ParticleBindings {
    blocks: wgpu::BindGroup,
    windows: Vec<wgpu::BindGroup>,
    /// Window and number of particles of each run, children behind their parents.
    runs: Vec<(usize, u32)>,
    run_stride: u32,
    /// Bindings and numbers of particles of the populations whose particles attract one another.
    mutual: Vec<(wgpu::BindGroup, u32)>,
    /// Bindings and numbers of particles of those that carry a force.
    carriers: Vec<(wgpu::BindGroup, u32)>,
    /// Bindings of those of whose ways samples are kept.
    histories: Vec<(wgpu::BindGroup, HistoryRun)>,
}

/// Rows to which the windows of populations are widened, so that they are aligned on any device.
pub(crate) const WINDOW_STEP: u32 = 16;

impl ParticleBindings {
    /// Bindings for the particles of a scene, so many to a window; `None` without any. `blocks` are the scene's, the step's and the tables.
    ///
    /// # Errors
    /// [`SimError::Capacity`] if children are too far from their parents for a window.
    pub(crate) fn new(
        gpu: &Gpu,
        pipelines: &Pipelines,
        compiled: &CompiledScene,
        blocks: [wgpu::BindingResource<'_>; 3],
        buffers: &WorldBuffers,
        page_particles: u32,
    ) -> Result<Option<Self>, SimError> {
        let count = buffers.particles().rows();
        if count == 0 {
            return Ok(None);
        }
        let run_stride =
            RUN_BYTES.next_multiple_of(gpu.device().limits().min_uniform_buffer_offset_alignment);
        let mut bytes = Vec::new();
        let mut runs = Vec::new();
        let mut add = |window: usize, page_slot: u32, slots: Range<u32>| {
            let (first, count) = (slots.start - page_slot, slots.end - slots.start);
            let run = ParticleRun { first, count, page_slot, unused: 0 };
            bytes.extend_from_slice(bytemuck::bytes_of(&run));
            bytes.resize(bytes.len().next_multiple_of(run_stride as usize), 0);
            runs.push((window, count));
        };
        let populations = &compiled.block().populations[..compiled.scene().particles.len()];
        let (children, roots): (Vec<&PopulationBlock>, Vec<_>) =
            populations.iter().partition(|population| population.nest.fan != 0);
        let page = |first: u32| first..count.min(first.saturating_add(page_particles));
        let mut windows: Vec<Range<u32>> = (0..count).step_by(page_particles as usize).map(page).collect();
        for (number, page) in windows.iter().enumerate() {
            // A run for each population, so that all invocations of a workgroup take the same way through the kernel.
            for population in &roots {
                let first = page.start.max(population.first_slot);
                let end = page.end.min(population.first_slot + population.count);
                if first < end {
                    add(number, page.start, first..end);
                }
            }
        }
        for population in children {
            let first = population.nest.parent_slot / WINDOW_STEP * WINDOW_STEP;
            let end = population.first_slot + population.count;
            if end - first > page_particles {
                return Err(too_far(gpu, end - first, page_particles));
            }
            add(windows.len(), first, population.first_slot..end);
            windows.push(first..end);
        }
        let run_blocks = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("particle runs"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue().write_buffer(&run_blocks, 0, &bytes);
        let has_mutual = compiled.has_mutual();
        let pull_rows = if has_mutual { u64::from(count) } else { 1 };
        let pulls = buffer(gpu, "particle pulls", pull_rows * 16, wgpu::BufferUsages::STORAGE);
        let carrier_rows = compiled.carriers().iter().map(|run| run.first_row + run.count * CARRIER_ROWS);
        let carrier_rows = u64::from(carrier_rows.max().unwrap_or(1));
        let carried = buffer(gpu, "carried forces", carrier_rows * 16, wgpu::BufferUsages::STORAGE);
        let has_starts = compiled.start_count() > 0;
        let start_rows = compiled.start_count().max(1) as u64;
        let starts = buffer(gpu, "particle starts", start_rows * START_BYTES, wgpu::BufferUsages::STORAGE);
        let window = |window: &Range<u32>| {
            let first = window.start;
            let run = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &run_blocks,
                offset: 0,
                size: wgpu::BufferSize::new(RUN_BYTES.into()),
            });
            let columns = buffers.particles().windows(first, window.end - first);
            let tallies = buffers.tallies().windows(0, buffers.tallies().rows());
            let pulls = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &pulls,
                offset: if has_mutual { u64::from(first) * 16 } else { 0 },
                size: None,
            });
            let starts = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &starts,
                offset: if has_starts { u64::from(first) * START_BYTES } else { 0 },
                size: has_starts
                    .then(|| wgpu::BufferSize::new(u64::from(window.end - first) * START_BYTES))
                    .flatten(),
            });
            let others = [pulls, carried.as_entire_binding(), starts];
            let resources = std::iter::once(run).chain(columns).chain(tallies).chain(others);
            group(gpu, pipelines.layout(GroupLayout::Particles), resources)
        };
        let mutual = |population: &PopulationBlock| {
            let first = population.first_slot / WINDOW_STEP * WINDOW_STEP;
            let offset = population.first_slot - first;
            let run = ParticleRun { first: offset, count: population.count, page_slot: first, unused: 0 };
            let run = uniform(gpu, "mutual run", &run);
            let column = |column| {
                wgpu::BindingResource::Buffer(buffers.particles().window(
                    column,
                    first,
                    offset + population.count,
                ))
            };
            let resources = [run.as_entire_binding(), column(0), column(1), pulls.as_entire_binding()];
            (group(gpu, pipelines.layout(GroupLayout::Mutual), resources), population.count)
        };
        let is_mutual = |population: &&PopulationBlock| (population.flags & POPULATION_MUTUAL) != 0;
        let mutual = compiled.block().populations.iter().filter(is_mutual).map(mutual).collect();
        let carrier = |run: &CarrierRun| {
            let first = run.first / WINDOW_STEP * WINDOW_STEP;
            let offset = run.first - first;
            let block = uniform(gpu, "carrier run", &CarrierRun { first: offset, ..*run });
            let columns = buffers.particles().windows(first, offset + run.count);
            let resources = std::iter::once(block.as_entire_binding())
                .chain(columns)
                .chain([carried.as_entire_binding()]);
            (group(gpu, pipelines.layout(GroupLayout::ForceCarriers), resources), run.count)
        };
        let carriers = compiled.carriers().iter().map(carrier).collect();
        let history = |(_, run): &(usize, HistoryRun)| {
            let first = run.first / WINDOW_STEP * WINDOW_STEP;
            let offset = run.first - first;
            let block = uniform(gpu, "history run", &HistoryRun { first: offset, ..*run });
            let places = buffers.particles().window(0, first, offset + run.count);
            let samples = buffers.history().windows(0, buffers.history().rows());
            let resources = [block.as_entire_binding(), wgpu::BindingResource::Buffer(places)];
            (group(gpu, pipelines.layout(GroupLayout::History), resources.into_iter().chain(samples)), *run)
        };
        let histories = compiled.histories().iter().map(history).collect();
        let blocks = group(gpu, pipelines.layout(GroupLayout::Blocks), blocks);
        let windows = windows.iter().map(window).collect();
        Ok(Some(Self { blocks, windows, runs, run_stride, mutual, carriers, histories }))
    }

    /// Encodes the places of carried forces, by the pipeline for it, where there are any.
    pub(crate) fn encode_carriers<'a>(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: impl FnOnce() -> &'a wgpu::ComputePipeline,
        step_offset: u32,
    ) {
        if self.carriers.is_empty() {
            return;
        }
        pass.set_pipeline(pipeline());
        pass.set_bind_group(0, &self.blocks, &[step_offset]);
        for (bound, count) in &self.carriers {
            pass.set_bind_group(1, bound, &[]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }

    /// Encodes the attractions of particles by one another, by the pipeline for it, where there are any.
    pub(crate) fn encode_pulls<'a>(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: impl FnOnce() -> &'a wgpu::ComputePipeline,
        step_offset: u32,
    ) {
        if self.mutual.is_empty() {
            return;
        }
        pass.set_pipeline(pipeline());
        pass.set_bind_group(0, &self.blocks, &[step_offset]);
        for (bound, count) in &self.mutual {
            pass.set_bind_group(1, bound, &[0]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }

    /// Encodes the samples of ways that are due after step number `index`, by the pipeline for them.
    pub(crate) fn encode_history<'a>(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: impl FnOnce() -> &'a wgpu::ComputePipeline,
        (index, step_offset): (u32, u32),
    ) {
        let time = index.wrapping_add(1);
        let mut due = self.histories.iter().filter(|(_, run)| history_is_due(run, time)).peekable();
        if due.peek().is_none() {
            return;
        }
        pass.set_pipeline(pipeline());
        pass.set_bind_group(0, &self.blocks, &[step_offset]);
        for (bound, run) in due {
            pass.set_bind_group(1, bound, &[]);
            pass.dispatch_workgroups(run.count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }

    /// Encodes a step of all particles, whose step block lies at `step_offset`.
    pub(crate) fn encode(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: &wgpu::ComputePipeline,
        step_offset: u32,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.blocks, &[step_offset]);
        for (number, &(window, count)) in (0..).zip(&self.runs) {
            pass.set_bind_group(1, &self.windows[window], &[number * self.run_stride]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }
}

/// Error of a population that is born of another, too many slots before it for a window.
fn too_far(gpu: &Gpu, rows: u32, page_particles: u32) -> SimError {
    let bytes = |rows: u32| u64::from(rows) * size_of::<ParticlePlace>() as u64;
    SimError::Capacity {
        store: "particles from the first parent to the last child",
        rows: rows as usize,
        needed: bytes(rows),
        allowed: bytes(page_particles),
        device: describe_adapter(gpu.info()),
    }
}
