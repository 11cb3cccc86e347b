// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the water, in every hollow that it fills.

use super::frame::FrameGroup;
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};
use crate::land::Land;

/// The water pipeline.
#[derive(Debug)]
pub(super) struct WaterPass {
    pipeline: wgpu::RenderPipeline,
}

impl WaterPass {
    /// `None` on dry land.
    pub(super) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        land: &Land,
    ) -> Option<Self> {
        land.water_m()?;
        let shader = shader(device, "water", &[COMMON, LIGHT, include_str!("shaders/water.wgsl")]);
        let pipeline = ScenePipeline {
            label: "water",
            groups: &[Some(&frame.layout), Some(&light.layout)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &[],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Some(Self { pipeline })
    }

    /// Draws the water; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..24, 0..1);
    }
}
