// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trees of a world on the device: constants, and the passes that move them.

use windfall_core::scene::MAX_FOREST_SEGMENTS;
use windfall_core::tree::Forest;
use windfall_core::tree::record::{BRANCH_COLUMNS, BRANCH_TURN, LevelBlock, WORK_ROWS};

use crate::buffers::{buffer, filled, group};
use crate::columns::StoreBuffers;
use crate::gpu::Gpu;
use crate::pipelines::{GroupLayout, Pipelines};
use crate::prelude::{MAX_GROUPS, WORKGROUP_SIZE};

const _: () = assert!(
    MAX_FOREST_SEGMENTS <= (MAX_GROUPS * WORKGROUP_SIZE) as usize,
    "an invocation for every segment of a dispatch"
);
/// Bytes of a row.
const ROW_BYTES: u64 = 16;
/// Bytes of the block of a level.
#[expect(clippy::cast_possible_truncation, reason = "a few words")]
const LEVEL_BYTES: u32 = size_of::<LevelBlock>() as u32;

/// All trees on the device.
#[derive(Debug)]
pub(crate) struct ForestBuffers {
    /// Rows of each level.
    levels: Vec<u32>,
    sway: wgpu::BindGroup,
    level_group: wgpu::BindGroup,
    level_stride: u32,
}

impl ForestBuffers {
    /// Buffers and bindings for the trees of a forest, whose state lies in `branches`. `blocks` are the scene's, the step's
    /// and the wind tables.
    pub(crate) fn new(
        gpu: &Gpu,
        pipelines: &Pipelines,
        forest: &Forest,
        blocks: [wgpu::BindingResource<'_>; 3],
        branches: &StoreBuffers,
    ) -> Self {
        let stride = branches.stride(BRANCH_TURN as usize);
        let segments = filled(gpu, "segments", bytemuck::cast_slice(forest.segments()));
        let order = filled(gpu, "forest order", bytemuck::cast_slice(forest.order()));
        let work_size = u64::from(stride * WORK_ROWS) * ROW_BYTES;
        let work = buffer(gpu, "sway", work_size, wgpu::BufferUsages::STORAGE);

        let level_stride =
            LEVEL_BYTES.next_multiple_of(gpu.device().limits().min_uniform_buffer_offset_alignment);
        let mut bytes = Vec::new();
        let mut levels = Vec::new();
        let mut start = 0;
        for &end in forest.level_ends() {
            let block = LevelBlock { first: start, count: end - start, column_stride: stride, unused: 0 };
            bytes.extend_from_slice(bytemuck::bytes_of(&block));
            bytes.resize(bytes.len().next_multiple_of(level_stride as usize), 0);
            levels.push(end - start);
            start = end;
        }
        let level_blocks = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("levels"),
            size: bytes.len().max(LEVEL_BYTES as usize) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue().write_buffer(&level_blocks, 0, &bytes);
        let level = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &level_blocks,
            offset: 0,
            size: wgpu::BufferSize::new(LEVEL_BYTES.into()),
        });
        let resources = [
            level,
            segments.as_entire_binding(),
            order.as_entire_binding(),
            branches.buffer(BRANCH_TURN as usize).as_entire_binding(),
            work.as_entire_binding(),
            branches.buffer(BRANCH_COLUMNS as usize).as_entire_binding(),
        ];
        let level_group = group(gpu, pipelines.layout(GroupLayout::Level), resources);
        let sway = blocks_group(gpu, pipelines, blocks);
        Self { levels, sway, level_group, level_stride }
    }

    /// Takes over other blocks or wind tables; the trees stay as they are.
    pub(crate) fn rebind(
        &mut self,
        gpu: &Gpu,
        pipelines: &Pipelines,
        blocks: [wgpu::BindingResource<'_>; 3],
    ) {
        self.sway = blocks_group(gpu, pipelines, blocks);
    }

    /// Encodes a step of all trees, whose step block lies at `step_offset`, by the pipelines of a scheme: its inward and its
    /// outward pass.
    pub(crate) fn encode(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        [inward, outward]: [&wgpu::ComputePipeline; 2],
        step_offset: u32,
    ) {
        pass.set_bind_group(0, &self.sway, &[step_offset]);
        let numbers = 0..u32::try_from(self.levels.len()).expect("levels are counted in words");
        pass.set_pipeline(inward);
        numbers.clone().rev().for_each(|number| self.encode_level(pass, number));
        pass.set_pipeline(outward);
        numbers.for_each(|number| self.encode_level(pass, number));
    }

    /// Encodes a step between two solutions of the joints, by the pipeline for it.
    pub(crate) fn encode_coast(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        coast: &wgpu::ComputePipeline,
        step_offset: u32,
    ) {
        pass.set_bind_group(0, &self.sway, &[step_offset]);
        pass.set_bind_group(1, &self.level_group, &[0]);
        pass.set_pipeline(coast);
        let rows: u32 = self.levels.iter().sum();
        pass.dispatch_workgroups(rows.div_ceil(WORKGROUP_SIZE), 1, 1);
    }

    /// Encodes a dispatch over all segments in their order, whose first group is bound.
    pub(crate) fn encode_segments(&self, pass: &mut wgpu::ComputePass<'_>, segments: u32) {
        pass.set_bind_group(1, &self.level_group, &[0]);
        pass.dispatch_workgroups(segments.div_ceil(WORKGROUP_SIZE), 1, 1);
    }

    /// One dispatch over a level.
    fn encode_level(&self, pass: &mut wgpu::ComputePass<'_>, number: u32) {
        pass.set_bind_group(1, &self.level_group, &[number * self.level_stride]);
        pass.dispatch_workgroups(self.levels[number as usize].div_ceil(WORKGROUP_SIZE), 1, 1);
    }
}

fn blocks_group(gpu: &Gpu, pipelines: &Pipelines, blocks: [wgpu::BindingResource<'_>; 3]) -> wgpu::BindGroup {
    group(gpu, pipelines.layout(GroupLayout::Blocks), blocks)
}
