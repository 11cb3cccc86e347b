// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws trunks, limbs and twigs, moved with the branches on the device.

use super::bark_mesh::{BarkBuffers, BarkVertex};
use super::branch_group::BranchGroup;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;

/// The bark pipeline.
#[derive(Debug)]
pub(crate) struct BarkPass {
    pipeline: wgpu::RenderPipeline,
}

impl BarkPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        branches: &BranchGroup,
    ) -> Self {
        let shader = compile(device, &super::shaders(), "trees/bark_pass");
        let pipeline = ScenePipeline {
            label: "bark",
            frame,
            groups: &[&light.layout, &branches.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            vertex: "vertex",
            constants: &[],
            buffers: &[BarkVertex::layout(wgpu::VertexStepMode::Vertex)],
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws all trees; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup, mesh: &BarkBuffers) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, group, &[]);
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        // The instance is the number of the tree's record; the first is that of no tree.
        for (range, record) in mesh.trees.iter().zip(1..) {
            pass.draw_indexed(range.clone(), 0, record..record + 1);
        }
    }
}
