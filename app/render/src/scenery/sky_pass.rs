// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the sky behind everything.

use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;

/// The sky pipeline.
#[derive(Debug)]
pub(crate) struct SkyPass {
    pipeline: wgpu::RenderPipeline,
}

impl SkyPass {
    pub(crate) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup) -> Self {
        let shader = compile(device, &super::shaders(), "scenery/sky_pass");
        let pipeline = ScenePipeline {
            label: "sky",
            frame,
            groups: &[&light.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[],
            blend: None,
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws the sky where nothing nearer is; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..3, 0..1);
    }
}
