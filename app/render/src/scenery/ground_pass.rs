// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the ground out to the horizon.

use super::terrain_mesh::TerrainMesh;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;
use crate::land::Land;

/// The ground pipeline.
#[derive(Debug)]
pub(crate) struct GroundPass {
    pipeline: wgpu::RenderPipeline,
    /// The grid that hills are drawn with; level ground needs none.
    mesh: Option<TerrainMesh>,
}

impl GroundPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        land: &Land,
    ) -> Self {
        let mesh = land.hills().map(|_| TerrainMesh::new(device, queue));
        let shader = compile(device, &super::shaders(), "scenery/ground_pass");
        let pipeline = ScenePipeline {
            label: "ground",
            frame,
            groups: &[&light.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            culls_back: false,
            shader: &shader,
            vertex: if mesh.is_some() { "vertex_hilly" } else { "vertex_level" },
            constants: &[],
            buffers: if mesh.is_some() { &[TerrainMesh::LAYOUT] } else { &[] },
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline, mesh }
    }

    /// Draws the ground; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        match &self.mesh {
            Some(mesh) => mesh.draw(pass),
            None => pass.draw(0..24, 0..1),
        }
    }
}
