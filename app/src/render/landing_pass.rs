// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shows how densely leaves lie on the ground: counts them on the device, and lays colours over the land.

use glam::Vec3;
use windfall_wgpu::LeafColumns;

use super::frame::FrameGroup;
use super::leaf_crowd::PAGE_SLOTS;
use super::leaf_record::record_constants;
use super::light_group::LightGroup;
use super::paint::{SHADES, shade};
use super::pipeline::{COMMON, LIGHT, ScenePipeline, buffer_entry, layout, shader};
use super::upload;

/// Leaves per square metre at the ends of the colours, which go by ratios.
pub const LANDINGS_PER_M2: (f32, f32) = (1.0, 100.0);
/// Cells along an edge of the square, and the edge of one in metres.
const CELLS: u32 = 160;
const CELL_M: f32 = 0.5;
/// Leaves that a workgroup counts.
const GROUP_SIZE: u32 = 64;
/// Bytes of a record of a column.
const COLUMN_BYTES: u64 = 16;

/// `Landing` of the landing shaders.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct LandingUniform {
    square: [f32; 4],
    scale: [f32; 4],
    palette: [[f32; 4]; SHADES],
}

/// The counts, and the pipelines that make and show them.
#[derive(Debug)]
pub(super) struct LandingPass {
    uniform: wgpu::Buffer,
    cells: wgpu::Buffer,
    count_layout: wgpu::BindGroupLayout,
    count_pipeline: wgpu::ComputePipeline,
    draw_group: wgpu::BindGroup,
    draw_pipeline: wgpu::RenderPipeline,
}

impl LandingPass {
    /// Counts in a square around `center`.
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        center: Vec3,
    ) -> Self {
        let half = 0.5 * CELL_M * CELLS as f32;
        let uniform = LandingUniform {
            square: [center.x - half, center.z - half, CELL_M, CELLS as f32],
            scale: [LANDINGS_PER_M2.0, LANDINGS_PER_M2.1, 0.0, 0.0],
            palette: std::array::from_fn(|index| {
                shade(index as f32 / (SHADES - 1) as f32).extend(1.0).to_array()
            }),
        };
        let usage = wgpu::BufferUsages::UNIFORM;
        let uniform = upload::buffer(device, queue, "landings", usage, bytemuck::bytes_of(&uniform));
        let cells = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("landings"),
            size: u64::from(CELLS * CELLS) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let (compute, vertex) = (wgpu::ShaderStages::COMPUTE, wgpu::ShaderStages::VERTEX);
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let block = wgpu::BufferBindingType::Uniform;
        let count_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("landing counts"),
            entries: &[
                buffer_entry(0, block, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(false), compute),
            ],
        });
        let text = [&record_constants(), include_str!("shaders/landing_count.wgsl")];
        let module = shader(device, "landing counts", &text);
        let count_pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("landing counts"),
            layout: Some(&layout(device, &[Some(&count_layout)])),
            module: &module,
            entry_point: Some("count"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let draw_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("landings"),
            entries: &[
                buffer_entry(0, block, vertex | wgpu::ShaderStages::FRAGMENT),
                buffer_entry(1, storage(true), vertex),
            ],
        });
        let draw_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("landings"),
            layout: &draw_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: cells.as_entire_binding() },
            ],
        });
        let module = shader(device, "landings", &[COMMON, LIGHT, include_str!("shaders/landing.wgsl")]);
        let draw_pipeline = ScenePipeline {
            label: "landings",
            groups: &[Some(&frame.layout), Some(&light.layout), Some(&draw_layout)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &module,
            buffers: &[],
            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { uniform, cells, count_layout, count_pipeline, draw_group, draw_pipeline }
    }

    /// Counts `leaves` as they lie now.
    pub(super) fn count(
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
                layout: &self.count_layout,
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
            pass.set_pipeline(&self.count_pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(count.div_ceil(GROUP_SIZE), 1, 1);
        }
    }

    /// Lays the colours over the ground; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.draw_pipeline);
        pass.set_bind_group(2, &self.draw_group, &[]);
        pass.draw(0..6, 0..CELLS * CELLS);
    }
}
