// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves: instanced, cut out by coverage, in any order.

use super::bark_pass::STEM;
use super::frame::FrameGroup;
use super::leaf_kinds::LeafKinds;
use super::leaf_record::record_constants;
use super::leaf_set::{LeafDetail, LeafMeshes, LeafSet, draw_leaves, vertex_layouts};
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};
use super::stems::Stems;

/// WGSL from leaf columns to points on blades.
pub(super) const LEAF_SHAPE: &str = include_str!("shaders/leaf_shape.wgsl");

/// The leaf pipeline.
#[derive(Debug)]
pub(super) struct LeafPass {
    pipeline: wgpu::RenderPipeline,
}

impl LeafPass {
    pub(super) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        kinds: &LeafKinds,
    ) -> Self {
        let text = [COMMON, LIGHT, STEM, &record_constants(), LEAF_SHAPE, include_str!("shaders/leaf.wgsl")];
        let shader = shader(device, "leaf", &text);
        let pipeline = ScenePipeline {
            label: "leaves",
            groups: &[Some(&frame.layout), Some(&light.layout), Some(&kinds.layout)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &vertex_layouts(),
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws sets of leaves; bind groups 0 and 1 are set.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        kinds: &LeafKinds,
        sets: &[LeafSet<'_>],
        stems: &Stems,
        meshes: &LeafMeshes,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &kinds.group, &[]);
        for set in sets {
            draw_leaves(pass, set, stems, meshes, LeafDetail::Own);
        }
    }
}
