// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counts on the device how many leaves lie in the cells of a square.

use glam::Vec3;
use windfall_core::layout::Float4;
use windfall_core::shared_struct;
use windfall_wgpu::LeafColumns;

use super::MARKS_GROUP_SIZE;
use super::palette::{SHADES, shade};
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::gpu::upload;
use crate::leaves::page::PAGE_SLOTS;
use crate::leaves::record::COLUMN_BYTES;

/// Leaves per square metre at the ends of the colours, which go by ratios.
pub const LANDINGS_PER_M2: (f32, f32) = (1.0, 100.0);
/// Cells along an edge of the square, and the edge of one in metres.
pub(crate) const CELLS: u32 = 160;
pub(crate) const CELL_M: f32 = 0.5;

shared_struct! {
    /// The square that is counted, and its colours.
    pub(crate) struct LandingUniform, padding 8 {
        /// Colours from few leaves to many, w unused.
        palette: [Float4; SHADES as usize],
        /// Lowest x and z of the square.
        corner_m: [f32; 2],
        /// Edge of a cell.
        cell_m: f32,
        /// Cells along an edge.
        cells: u32,
        /// Leaves per square metre at the first colour.
        low_per_m2: f32,
        /// Leaves per square metre at the last.
        high_per_m2: f32,
    }
}

/// The counts, and the pipeline that makes them.
#[derive(Debug)]
pub(crate) struct LandingCount {
    pub(crate) uniform: wgpu::Buffer,
    /// A word for each cell, row by row of z.
    pub(crate) cells: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl LandingCount {
    /// Counts in a square around `center`.
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, center: Vec3) -> Self {
        let half = 0.5 * CELL_M * CELLS as f32;
        let uniform = LandingUniform {
            palette: std::array::from_fn(|index| {
                Float4(shade(index as f32 / (SHADES - 1) as f32).extend(1.0).to_array())
            }),
            corner_m: [center.x - half, center.z - half],
            cell_m: CELL_M,
            cells: CELLS,
            low_per_m2: LANDINGS_PER_M2.0,
            high_per_m2: LANDINGS_PER_M2.1,
            padding: [0; 8],
        };
        let usage = wgpu::BufferUsages::UNIFORM;
        let uniform = upload::buffer(device, queue, "landings", usage, bytemuck::bytes_of(&uniform));
        let cells = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("landings"),
            size: u64::from(CELLS * CELLS) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("landing counts"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(false), compute),
            ],
        });
        let module = compile(device, &super::shaders(), "marks/landing_count");
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("landing counts"),
            layout: Some(&layout(device, &[Some(&group_layout)])),
            module: &module,
            entry_point: Some("count"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { uniform, cells, layout: group_layout, pipeline }
    }

    /// Counts `leaves` as they lie now.
    pub(crate) fn run(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        leaves: &LeafColumns<'_>,
    ) {
        encoder.clear_buffer(&self.cells, 0, None);
        for first in (0..leaves.leaf_count).step_by(PAGE_SLOTS as usize) {
            let count = PAGE_SLOTS.min(leaves.leaf_count - first);
            let window = wgpu::BufferBinding {
                buffer: leaves.place,
                offset: u64::from(first) * COLUMN_BYTES,
                size: wgpu::BufferSize::new(u64::from(count) * COLUMN_BYTES),
            };
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("landing counts"),
                layout: &self.layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Buffer(window) },
                    wgpu::BindGroupEntry { binding: 2, resource: self.cells.as_entire_binding() },
                ],
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("landing counts"),
                timestamp_writes: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(count.div_ceil(MARKS_GROUP_SIZE), 1, 1);
        }
    }
}
