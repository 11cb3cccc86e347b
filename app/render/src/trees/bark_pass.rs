// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws trunks, limbs and twigs, moved with the branches on the device.

use super::bark_mesh::{StandMesh, bark_layout};
use super::branch_group::BranchGroup;
use super::records::Stems;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::{COMMON, LIGHT, ScenePipeline};
use crate::gpu::pipeline::shader;

/// WGSL from branch columns to places on the bark.
pub(crate) const BARK_SHAPE: &str = include_str!("bark_shape.wgsl");
/// WGSL of what the parts of a tree share.
pub(crate) const STEM: &str = include_str!("records.wgsl");

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
        let text = [COMMON, LIGHT, STEM, BARK_SHAPE, include_str!("bark_pass.wgsl")];
        let shader = shader(device, "bark", &text);
        let pipeline = ScenePipeline {
            label: "bark",
            frame,
            groups: &[&light.layout, &branches.layout],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &[bark_layout(), Stems::layout()],
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws all trees; bind groups 0 and 1 are set.
    pub(crate) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        group: &wgpu::BindGroup,
        mesh: &StandMesh,
        stems: &Stems,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, group, &[]);
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        for (tree, range) in mesh.trees.iter().enumerate() {
            pass.set_vertex_buffer(1, stems.of(Some(tree)));
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }
}
