// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trees of a world on the device: constants, state, and the passes that move them.

use windfall_core::SimError;
use windfall_core::tree::record::{BRANCH_BASE, BRANCH_COLUMNS, BRANCH_POSE, WORK_ROWS};
use windfall_core::tree::{Branches, Forest};

use crate::buffers::{buffer, filled, group};
use crate::columns::BranchColumns;
use crate::gpu::Gpu;
use crate::pipelines::Pipelines;
use crate::prelude::WORKGROUP_SIZE;
use crate::readback::read_buffer;
use crate::simulator::MAX_GROUPS;

/// Columns begin at a multiple of this many rows, so that each can be bound on any device.
const COLUMN_STEP: u32 = 16;
/// Bytes of a row.
const ROW_BYTES: u64 = 16;

/// The columns of all segments as one buffer. A clone is the same buffer.
#[derive(Clone, Debug)]
pub struct BranchBuffer {
    rows: wgpu::Buffer,
    count: u32,
    stride: u32,
}

impl BranchBuffer {
    /// A buffer for `count` segments.
    ///
    /// # Errors
    /// A lost device.
    pub fn new(gpu: &Gpu, count: usize) -> Result<Self, SimError> {
        let count = u32::try_from(count).expect("segments are counted in words");
        let stride = count.next_multiple_of(COLUMN_STEP).max(COLUMN_STEP);
        let size = u64::from(stride * BRANCH_COLUMNS) * ROW_BYTES;
        let rows = storage(gpu, "branches", size);
        gpu.check()?;
        Ok(Self { rows, count, stride })
    }

    /// Replaces the state.
    ///
    /// # Errors
    /// [`SimError::Segments`] if there are more or fewer segments.
    pub fn write(&self, gpu: &Gpu, branches: &Branches) -> Result<(), SimError> {
        if branches.len() != self.count as usize {
            return Err(SimError::Segments { world: branches.len(), simulator: self.count as usize });
        }
        for (column, rows) in (0..).zip(branches.columns()) {
            gpu.queue().write_buffer(&self.rows, self.offset(column), bytemuck::cast_slice(rows));
        }
        gpu.check()
    }

    /// The columns, to draw from.
    pub fn columns(&self) -> BranchColumns<'_> {
        let column = |column| wgpu::BufferBinding {
            buffer: &self.rows,
            offset: self.offset(column),
            size: wgpu::BufferSize::new(u64::from(self.stride) * ROW_BYTES),
        };
        BranchColumns { base: column(BRANCH_BASE), pose: column(BRANCH_POSE), count: self.count }
    }

    fn offset(&self, column: u32) -> u64 {
        u64::from(column) * u64::from(self.stride) * ROW_BYTES
    }
}

/// All trees on the device.
#[derive(Debug)]
pub(crate) struct ForestBuffers {
    branches: BranchBuffer,
    bearing: wgpu::Buffer,
    /// Rows of each level.
    levels: Vec<u32>,
    sway: wgpu::BindGroup,
    level_group: wgpu::BindGroup,
    level_stride: u32,
}

impl ForestBuffers {
    /// Room for a forest, with the state of trees of the same size that are `standing`, else to be written by `write`.
    /// `blocks` are the environment, the step and the wind tables.
    pub(crate) fn new(
        gpu: &Gpu,
        pipelines: &Pipelines,
        forest: &Forest,
        blocks: [wgpu::BindingResource<'_>; 3],
        standing: Option<&Self>,
    ) -> Result<Self, SimError> {
        let (branches, bearing) = match standing {
            Some(standing) => (standing.branches.clone(), standing.bearing.clone()),
            None => {
                let branches = BranchBuffer::new(gpu, forest.len())?;
                let bearing = storage(gpu, "bearing", u64::from(branches.stride) * 4);
                (branches, bearing)
            }
        };
        let timber = filled(gpu, "timber", bytemuck::cast_slice(forest.timber()));
        let order = filled(gpu, "forest order", bytemuck::cast_slice(forest.order()));
        let work = storage(gpu, "sway", u64::from(branches.stride * WORK_ROWS) * ROW_BYTES);

        let level_stride = 16u32.next_multiple_of(gpu.device().limits().min_uniform_buffer_offset_alignment);
        let mut bytes = Vec::new();
        let mut levels = Vec::new();
        let mut start = 0;
        for &end in forest.level_ends() {
            let block = [start, end - start, branches.stride, 0];
            bytes.extend_from_slice(bytemuck::cast_slice(&block));
            bytes.resize(bytes.len().next_multiple_of(level_stride as usize), 0);
            levels.push(end - start);
            start = end;
        }
        let level_blocks = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("levels"),
            size: bytes.len().max(16) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue().write_buffer(&level_blocks, 0, &bytes);
        let level = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &level_blocks,
            offset: 0,
            size: wgpu::BufferSize::new(16),
        });
        let resources = [
            level,
            timber.as_entire_binding(),
            order.as_entire_binding(),
            branches.rows.as_entire_binding(),
            work.as_entire_binding(),
            bearing.as_entire_binding(),
        ];
        let level_group = group(gpu, &pipelines.level_layout, resources);
        let sway = sway_group(gpu, pipelines, blocks);
        gpu.check()?;
        Ok(Self { branches, bearing, levels, sway, level_group, level_stride })
    }

    /// Takes over other blocks or wind tables; the trees stay as they are.
    pub(crate) fn rebind(
        &mut self,
        gpu: &Gpu,
        pipelines: &Pipelines,
        blocks: [wgpu::BindingResource<'_>; 3],
    ) {
        self.sway = sway_group(gpu, pipelines, blocks);
    }

    /// The columns, to draw from.
    pub(crate) fn columns(&self) -> BranchColumns<'_> {
        self.branches.columns()
    }

    /// What carries leaves: the columns, and the counts of leaves on each segment.
    pub(crate) fn carriers(&self) -> [wgpu::BindingResource<'_>; 2] {
        [self.branches.rows.as_entire_binding(), self.bearing.as_entire_binding()]
    }

    /// Rows of a column.
    pub(crate) fn stride(&self) -> u32 {
        self.branches.stride
    }

    /// Replaces the state.
    pub(crate) fn write(&self, gpu: &Gpu, branches: &Branches) -> Result<(), SimError> {
        self.branches.write(gpu, branches)?;
        gpu.queue().write_buffer(&self.bearing, 0, bytemuck::cast_slice(&branches.bearing));
        gpu.check()
    }

    /// Copies the state out.
    pub(crate) fn read(&self, gpu: &Gpu, branches: &mut Branches) -> Result<(), SimError> {
        let mut rows = vec![[0f32; 4]; (self.branches.stride * BRANCH_COLUMNS) as usize];
        read_buffer(gpu, &self.branches.rows, bytemuck::cast_slice_mut(&mut rows))?;
        for (column, rows) in
            branches.columns_mut().into_iter().zip(rows.chunks(self.branches.stride as usize))
        {
            let count = column.len();
            column.copy_from_slice(&rows[..count]);
        }
        let mut bearing = vec![0u32; self.branches.stride as usize];
        read_buffer(gpu, &self.bearing, bytemuck::cast_slice_mut(&mut bearing))?;
        let count = branches.bearing.len();
        branches.bearing.copy_from_slice(&bearing[..count]);
        Ok(())
    }

    /// Encodes a step of all trees, whose step block lies at `step_offset`, by the pipelines of a scheme: towards the foot
    /// and towards the tips.
    pub(crate) fn encode(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        [inwards, outwards]: &[wgpu::ComputePipeline; 2],
        step_offset: u32,
    ) {
        pass.set_bind_group(0, &self.sway, &[step_offset]);
        let numbers = 0..u32::try_from(self.levels.len()).expect("levels are counted in words");
        pass.set_pipeline(inwards);
        numbers.clone().rev().for_each(|number| self.encode_level(pass, number));
        pass.set_pipeline(outwards);
        numbers.for_each(|number| self.encode_level(pass, number));
    }

    /// One dispatch over a level.
    fn encode_level(&self, pass: &mut wgpu::ComputePass<'_>, number: u32) {
        pass.set_bind_group(1, &self.level_group, &[number * self.level_stride]);
        pass.dispatch_workgroups(self.levels[number as usize].div_ceil(WORKGROUP_SIZE).min(MAX_GROUPS), 1, 1);
    }
}

fn sway_group(gpu: &Gpu, pipelines: &Pipelines, blocks: [wgpu::BindingResource<'_>; 3]) -> wgpu::BindGroup {
    group(gpu, &pipelines.sway_layout, blocks)
}

/// A storage buffer that can be copied from and to.
fn storage(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    buffer(gpu, label, size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC)
}
