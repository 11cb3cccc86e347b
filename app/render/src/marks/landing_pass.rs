// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shows how densely leaves lie on the ground: lays colours over the land.

use super::landing_count::{CELLS, LandingCount};
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::pipeline::buffer_entry;
use crate::gpu::shaders::compile;

/// The pipeline that shows the counts.
#[derive(Debug)]
pub(crate) struct LandingPass {
    pub(crate) count: LandingCount,
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl LandingPass {
    /// Shows `count`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        count: LandingCount,
    ) -> Self {
        let vertex = wgpu::ShaderStages::VERTEX;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let both = vertex | wgpu::ShaderStages::FRAGMENT;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("landings"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, both),
                buffer_entry(1, read, vertex),
            ],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("landings"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: count.uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: count.cells.as_entire_binding() },
            ],
        });
        let module = compile(device, &super::shaders(), "marks/landing_pass");
        let pipeline = ScenePipeline {
            label: "landings",
            frame,
            groups: &[&light.layout, &layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &module,
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { count, group, pipeline }
    }

    /// Lays the colours over the ground; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &self.group, &[]);
        pass.draw(0..6, 0..CELLS * CELLS);
    }
}
