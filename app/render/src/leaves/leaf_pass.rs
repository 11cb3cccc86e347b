// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves: instanced, cut out by coverage, in any order.

use super::cull::CullPass;
use super::species_table::LeafKinds;
use super::visible::LeafCrowd;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::{COMMON, LIGHT, ScenePipeline};
use crate::gpu::pipeline::shader;

/// WGSL of the colour of a blade: its own, or that of its mark.
const COLORS: [&str; 2] = [include_str!("colors_own.wgsl"), include_str!("colors_painted.wgsl")];

/// WGSL from the records of leaves to points on blades; uses bind groups 2 and 3.
pub(crate) const LEAF_SHAPE: [&str; 3] =
    [include_str!("species_table.wgsl"), include_str!("record.wgsl"), include_str!("shape.wgsl")];

/// The leaf pipeline.
#[derive(Debug)]
pub(crate) struct LeafPass {
    pipeline: wgpu::RenderPipeline,
}

impl LeafPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        kinds: &LeafKinds,
        cull: &CullPass,
    ) -> Self {
        let [kind, record, shape] = LEAF_SHAPE;
        let colors = COLORS[usize::from(cull.is_painted)];
        let text = [COMMON, LIGHT, kind, record, shape, colors, include_str!("leaf_pass.wgsl")];
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
    pub(crate) fn draw<'a>(
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
