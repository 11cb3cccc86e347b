// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the sky behind everything.

use super::frame::FrameGroup;
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};

/// The sky pipeline.
#[derive(Debug)]
pub(super) struct SkyPass {
    pipeline: wgpu::RenderPipeline,
}

impl SkyPass {
    pub(super) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup) -> Self {
        let shader = shader(device, "sky", &[COMMON, LIGHT, include_str!("shaders/sky.wgsl")]);
        let pipeline = ScenePipeline {
            label: "sky",
            frame,
            groups: &[&light.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &[],
            blend: None,
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws the sky where nothing nearer is; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..3, 0..1);
    }
}
