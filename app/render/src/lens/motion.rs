// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ways over the picture of what moves while the shutter is open: a pass that draws them where things were drawn before.

use windfall_core::shared_struct;

use crate::frame::group::FrameGroup;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::targets::{DEPTH_FORMAT, SAMPLE_COUNT, Targets, WAY_FORMAT};

/// Speed in m/s beyond which a thing was put elsewhere.
const FASTEST_M_S: f32 = 80.0;

shared_struct! {
    /// Largest motion, and the time that the shutter is open.
    pub(crate) struct MotionUniform {
        /// Part of the way since the frame before that the shutter is open for.
        open_share: f32,
        /// Farthest way in metres: what went farther was put elsewhere.
        farthest_m: f32,
        /// Size of the tile in pixels.
        size_px: [f32; 2],
    }
}

/// The uniform block that all such pipelines read in bind group 1.
#[derive(Debug)]
pub(crate) struct Motion {
    uniform: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
}

impl Motion {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("motion"),
            entries: &[buffer_entry(0, wgpu::BufferBindingType::Uniform, wgpu::ShaderStages::VERTEX)],
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("motion"),
            size: size_of::<MotionUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("motion"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        Self { uniform, layout, group }
    }

    /// A pipeline of a shader module, with these groups after the first two.
    pub(crate) fn pipeline(
        &self,
        device: &wgpu::Device,
        (label, frame, module): (&str, &FrameGroup, &wgpu::ShaderModule),
        groups: &[&wgpu::BindGroupLayout],
        topology: wgpu::PrimitiveTopology,
        buffer: wgpu::VertexBufferLayout<'_>,
    ) -> wgpu::RenderPipeline {
        let first = [&frame.layout, &self.layout];
        let groups: Vec<_> = first.into_iter().chain(groups.iter().copied()).map(Some).collect();
        let constants = frame.overrides();
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(&layout(device, &groups)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: compilation_options.clone(),
                buffers: &[Some(buffer)],
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            // Only where the thing itself was drawn: what is cut out of it shows something deeper.
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Equal),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: SAMPLE_COUNT, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("fragment"),
                compilation_options,
                targets: &[Some(WAY_FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Begins to draw the ways since `since_s` seconds ago with the shutter open for `shutter_s`: a pass with bind groups 0 and 1 set.
    /// `None` where there is nothing to draw into, and, with the ways cleared, where there is no frame before.
    pub(crate) fn begin<'a>(
        &self,
        queue: &wgpu::Queue,
        encoder: &'a mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &FrameGroup,
        (since_s, shutter_s): (Option<f64>, f32),
    ) -> Option<wgpu::RenderPass<'a>> {
        let ways = targets.ways.as_ref()?;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("motion"),
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
        #[expect(clippy::cast_possible_truncation, reason = "a moment")]
        let moment_s = since_s? as f32;
        let (width, height) = targets.tile_size;
        let uniform = MotionUniform {
            open_share: shutter_s / moment_s,
            farthest_m: FASTEST_M_S * moment_s,
            size_px: [width as f32, height as f32],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        pass.set_bind_group(0, &frame.group, &[]);
        pass.set_bind_group(1, &self.group, &[]);
        Some(pass)
    }
}
