// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The particles of a world on the device, in windows that fit in one binding each.

use windfall_core::CompiledScene;
use windfall_core::blocks::PopulationBlock;
use windfall_core::device::particle::record::POPULATION_MUTUAL;
use windfall_core::particle::ParticleRun;

use crate::buffers::{buffer, group, uniform};
use crate::columns::WorldBuffers;
use crate::gpu::Gpu;
use crate::pipelines::{GroupLayout, Pipelines};
use crate::prelude::WORKGROUP_SIZE;

/// Bytes of the block of a run.
#[expect(clippy::cast_possible_truncation, reason = "a few words")]
const RUN_BYTES: u32 = size_of::<ParticleRun>() as u32;

/// Bindings of the particles of a world.
#[derive(Debug)]
pub(crate) struct ParticleBindings {
    blocks: wgpu::BindGroup,
    pages: Vec<wgpu::BindGroup>,
    /// Page and number of particles of each run.
    runs: Vec<(usize, u32)>,
    run_stride: u32,
    /// Bindings and numbers of particles of the populations whose particles attract one another.
    mutual: Vec<(wgpu::BindGroup, u32)>,
}

/// Rows to which the windows of populations are widened, so that they are aligned on any device.
const WINDOW_STEP: u32 = 16;

impl ParticleBindings {
    /// Bindings for the particles of a scene, so many to a page; `None` without any. `blocks` are the scene's, the step's and the tables.
    pub(crate) fn new(
        gpu: &Gpu,
        pipelines: &Pipelines,
        compiled: &CompiledScene,
        blocks: [wgpu::BindingResource<'_>; 3],
        buffers: &WorldBuffers,
        page_particles: u32,
    ) -> Option<Self> {
        let count = buffers.particles().rows();
        if count == 0 {
            return None;
        }
        let run_stride =
            RUN_BYTES.next_multiple_of(gpu.device().limits().min_uniform_buffer_offset_alignment);
        let mut bytes = Vec::new();
        let mut runs = Vec::new();
        let firsts: Vec<u32> = (0..count).step_by(page_particles as usize).collect();
        for (page, &page_slot) in firsts.iter().enumerate() {
            let page_end = count.min(page_slot.saturating_add(page_particles));
            // A run for each population, so that all invocations of a workgroup take the same way through the kernel.
            for population in &compiled.block().populations[..compiled.scene().particles.len()] {
                let first = page_slot.max(population.first_slot);
                let end = page_end.min(population.first_slot + population.count);
                if first < end {
                    let run =
                        ParticleRun { first: first - page_slot, count: end - first, page_slot, unused: 0 };
                    bytes.extend_from_slice(bytemuck::bytes_of(&run));
                    bytes.resize(bytes.len().next_multiple_of(run_stride as usize), 0);
                    runs.push((page, end - first));
                }
            }
        }
        let run_blocks = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("particle runs"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue().write_buffer(&run_blocks, 0, &bytes);
        let has_mutual = compiled.block().has_mutual();
        let pull_rows = if has_mutual { u64::from(count) } else { 1 };
        let pulls = buffer(gpu, "particle pulls", pull_rows * 16, wgpu::BufferUsages::STORAGE);
        let page = |&first: &u32| {
            let run = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &run_blocks,
                offset: 0,
                size: wgpu::BufferSize::new(RUN_BYTES.into()),
            });
            let columns = buffers.particles().windows(first, page_particles.min(count - first));
            let tallies = buffers.tallies().windows(0, buffers.tallies().rows());
            let pulls = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &pulls,
                offset: if has_mutual { u64::from(first) * 16 } else { 0 },
                size: None,
            });
            let resources = std::iter::once(run).chain(columns).chain(tallies).chain([pulls]);
            group(gpu, pipelines.layout(GroupLayout::Particles), resources)
        };
        let mutual = |population: &PopulationBlock| {
            let first = population.first_slot / WINDOW_STEP * WINDOW_STEP;
            let offset = population.first_slot - first;
            let run = ParticleRun { first: offset, count: population.count, page_slot: first, unused: 0 };
            let run = uniform(gpu, "mutual run", &run);
            let window = |column| {
                wgpu::BindingResource::Buffer(buffers.particles().window(
                    column,
                    first,
                    offset + population.count,
                ))
            };
            let resources = [run.as_entire_binding(), window(0), window(1), pulls.as_entire_binding()];
            (group(gpu, pipelines.layout(GroupLayout::Mutual), resources), population.count)
        };
        let is_mutual = |population: &&PopulationBlock| (population.flags & POPULATION_MUTUAL) != 0;
        let mutual = compiled.block().populations.iter().filter(is_mutual).map(mutual).collect();
        let blocks = group(gpu, pipelines.layout(GroupLayout::Blocks), blocks);
        Some(Self { blocks, pages: firsts.iter().map(page).collect(), runs, run_stride, mutual })
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

    /// Encodes a step of all particles, whose step block lies at `step_offset`.
    pub(crate) fn encode(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: &wgpu::ComputePipeline,
        step_offset: u32,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.blocks, &[step_offset]);
        for (number, &(page, count)) in (0..).zip(&self.runs) {
            pass.set_bind_group(1, &self.pages[page], &[number * self.run_stride]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }
}
