// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles that lie transparent over the scene, made from a uniform block and rows of a buffer.

use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::{buffer_entry, uniform_entry};
use crate::gpu::shaders::compile;

/// The pipeline, and what it reads in bind group 2.
#[derive(Debug)]
pub(super) struct Overlay {
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl Overlay {
    /// An overlay drawn by a shader module that binds `uniform` at 0 and `rows` at 1.
    pub(super) fn new(
        device: &wgpu::Device,
        (frame, light): (&FrameGroup, &LightGroup),
        label: &str,
        module: &'static str,
        [uniform, rows]: [&wgpu::Buffer; 2],
    ) -> Self {
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &[uniform_entry(0), buffer_entry(1, read, wgpu::ShaderStages::VERTEX)],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: rows.as_entire_binding() },
            ],
        });
        let pipeline = ScenePipeline {
            label,
            frame,
            groups: &[&light.layout, &layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &compile(device, &super::shaders(), module),
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { group, pipeline }
    }

    /// Draws so many instances of so many vertices; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, vertices: u32, instances: u32) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &self.group, &[]);
        pass.draw(0..vertices, 0..instances);
    }
}
