// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws how far leaves move over the picture while the shutter is open, from where they were a frame before.

use windfall_core::shared_struct;
use windfall_wgpu::LeafColumns;

use super::previous::PreviousLeaves;
use super::species_table::SpeciesTable;
use super::visible::VisibleLeaves;
use crate::frame::group::FrameGroup;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::gpu::targets::{DEPTH_FORMAT, SAMPLE_COUNT, Targets, WAY_FORMAT};

/// A leaf faster than this was put elsewhere, in m/s.
const FASTEST_M_S: f32 = 80.0;

shared_struct! {
    /// Largest motion of a leaf, and the time that the shutter is open.
    pub(crate) struct MotionUniform {
        /// Part of the way since the frame before that the shutter is open for.
        open_share: f32,
        /// Farthest way in metres: a leaf that went farther was put elsewhere.
        farthest_m: f32,
        /// Size of the tile in pixels.
        size_px: [f32; 2],
    }
}

/// The pipeline, where the leaves were, and what is drawn into.
#[derive(Debug)]
pub(crate) struct MotionPass {
    pipeline: wgpu::RenderPipeline,
    columns_layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    group: wgpu::BindGroup,
    pub(crate) past: PreviousLeaves,
}

impl MotionPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        species_table: &SpeciesTable,
        leaf_count: u32,
    ) -> Self {
        let vertex = wgpu::ShaderStages::VERTEX;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let columns_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("moving leaves"),
            entries: &[0, 1, 2, 3, 4].map(|binding| buffer_entry(binding, read, vertex)),
        });
        let uniform_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("motion"),
            entries: &[buffer_entry(0, wgpu::BufferBindingType::Uniform, vertex)],
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("motion"),
            size: size_of::<MotionUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("motion"),
            layout: &uniform_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let module = compile(device, &super::shaders(), "leaves/motion_pass");
        let groups =
            [Some(&frame.layout), Some(&uniform_layout), Some(&species_table.layout), Some(&columns_layout)];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("leaf motion"),
            layout: Some(&layout(device, &groups)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(VisibleLeaves::layout())],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..Default::default()
            },
            // Only where the leaf itself was drawn: what is cut out of it shows something deeper.
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Equal),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: SAMPLE_COUNT, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(WAY_FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, columns_layout, uniform, group, past: PreviousLeaves::new(device, leaf_count) }
    }

    /// Draws the ways of `visible` leaves at `time_s` with the shutter open for `shutter_s`; its culling has been done.
    pub(crate) fn draw(
        &self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        (frame, species_table, visible): (&FrameGroup, &SpeciesTable, &VisibleLeaves),
        leaves: &LeafColumns<'_>,
        (time_s, shutter_s): (f64, f32),
    ) {
        let Some(ways) = &targets.ways else { return };
        let since_s = self.past.since_s(leaves, time_s);
        let (width, height) = targets.tile_size;
        #[expect(clippy::cast_possible_truncation, reason = "a moment")]
        let moment_s = since_s.unwrap_or(1.0) as f32;
        let uniform = MotionUniform {
            open_share: shutter_s / moment_s,
            farthest_m: FASTEST_M_S * moment_s,
            size_px: [width as f32, height as f32],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("leaf motion"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &ways.samples,
                depth_slice: None,
                resolve_target: Some(&ways.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth,
                depth_ops: None,
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        if since_s.is_none() {
            return;
        }
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &frame.group, &[]);
        pass.set_bind_group(1, &self.group, &[]);
        pass.set_bind_group(2, &species_table.group, &[]);
        let columns = [leaves.place, leaves.attitude, &self.past.place, &self.past.attitude];
        visible.draw_with(device, &mut pass, &self.columns_layout, columns, leaves.leaf_count);
    }
}
