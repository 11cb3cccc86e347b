// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws objects and those who walk.

use super::records::ObjectBuffers;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;

/// The pipeline of objects.
#[derive(Debug)]
pub(crate) struct ObjectPass {
    pipeline: wgpu::RenderPipeline,
}

impl ObjectPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        objects: &ObjectBuffers,
    ) -> Self {
        let shader = compile(device, &super::shaders(), "objects/object_pass");
        let pipeline = ScenePipeline {
            label: "objects",
            frame,
            groups: &[&light.layout, &objects.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[ObjectBuffers::vertex_layout()],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws all objects; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, objects: &ObjectBuffers) {
        pass.set_pipeline(&self.pipeline);
        objects.draw(pass);
    }
}
