// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws soft shadows beneath leaves at rest, over what they lie on.

use super::cull::CullPass;
use super::species_table::SpeciesTable;
use super::visible::VisibleLeaves;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;

/// The pipeline of these shadows.
#[derive(Debug)]
pub(crate) struct ContactPass {
    pipeline: wgpu::RenderPipeline,
}

impl ContactPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        species_table: &SpeciesTable,
        cull: &CullPass,
    ) -> Self {
        let shader = compile(device, &super::shaders(), "leaves/contact_pass");
        let pipeline = ScenePipeline {
            label: "contact shadows",
            frame,
            groups: &[&light.layout, &species_table.layout, &cull.page_layouts.records],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            culls_back: false,
            shader: &shader,
            vertex: "vertex",
            constants: &[("LEAVES_BURN", f64::from(u8::from(species_table.leaves_burn)))],
            buffers: &[VisibleLeaves::layout()],
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            depth_write: false,
            alpha_to_coverage: false,
        }
        .build(device);
        Self { pipeline }
    }

    /// Draws the shadows of leaves as the last culling left them; bind groups 0 and 1 are set.
    pub(crate) fn draw<'a>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        species_table: &SpeciesTable,
        visible: impl Iterator<Item = &'a VisibleLeaves>,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &species_table.group, &[]);
        for leaves in visible {
            leaves.draw_squares(pass);
        }
    }
}
