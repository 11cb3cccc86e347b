// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the ground out to the horizon.

use super::frame::FrameGroup;
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};

/// WGSL of the meadow's colours.
pub(super) const GRASS_COLOR: &str = include_str!("shaders/grass_color.wgsl");

/// The ground pipeline.
#[derive(Debug)]
pub(super) struct GroundPass {
    pipeline: wgpu::RenderPipeline,
}

impl GroundPass {
    pub(super) fn new(device: &wgpu::Device, frame: &FrameGroup, light: &LightGroup) -> Self {
        let text = [COMMON, LIGHT, GRASS_COLOR, include_str!("shaders/ground.wgsl")];
        let shader = shader(device, "ground", &text);
        let pipeline = ScenePipeline {
            label: "ground",
            groups: &[Some(&frame.layout), Some(&light.layout)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &[],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws the ground; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..24, 0..1);
    }
}
