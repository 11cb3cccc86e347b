// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves: instanced, cut out by coverage, in any order.

use super::frame::FrameGroup;
use super::leaf_crowd::LeafCrowd;
use super::leaf_cull::CullPass;
use super::leaf_kinds::LeafKinds;
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};

/// WGSL of the colour of a blade: its own, or that of its mark.
const COLORS: [&str; 2] =
    [include_str!("shaders/colors_own.wgsl"), include_str!("shaders/colors_painted.wgsl")];

/// WGSL from the records of leaves to points on blades; uses bind groups 2 and 3.
pub(super) const LEAF_SHAPE: [&str; 3] = [
    include_str!("shaders/leaf_kinds.wgsl"),
    include_str!("shaders/leaf_record.wgsl"),
    include_str!("shaders/leaf_shape.wgsl"),
];

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
        cull: &CullPass,
    ) -> Self {
        let [kind, record, shape] = LEAF_SHAPE;
        let colors = COLORS[usize::from(cull.is_painted)];
        let text = [COMMON, LIGHT, kind, record, shape, colors, include_str!("shaders/leaf.wgsl")];
        let shader = shader(device, "leaf", &text);
        let pipeline = ScenePipeline {
            label: "leaves",
            frame,
            groups: &[&light.layout, &kinds.layout, &cull.records_layout],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            shader: &shader,
            buffers: &[LeafCrowd::layout()],
            blend: None,
            depth_write: true,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws crowds of leaves as the camera's culling left them; bind groups 0 and 1 are set.
    pub(super) fn draw<'a>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        kinds: &LeafKinds,
        crowds: impl Iterator<Item = &'a LeafCrowd>,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &kinds.group, &[]);
        for crowd in crowds {
            crowd.draw(pass);
        }
    }
}
