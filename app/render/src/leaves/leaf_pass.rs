// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves: instanced, cut out by coverage, in any order.

use super::cull::CullPass;
use super::meshes::LEVELS;
use super::small_leaf_light::SmallLeafLight;
use super::species_table::SpeciesTable;
use super::visible::VisibleLeaves;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::scene_pipeline::ScenePipeline;
use crate::gpu::shaders::compile;

/// The pipelines of leaves.
#[derive(Debug)]
pub(crate) struct LeafPass {
    /// Lit point by point.
    fine: wgpu::RenderPipeline,
    /// Lit once each: leaves of a few pixels. None where leaves burn, which shows point by point.
    small: Option<(SmallLeafLight, wgpu::RenderPipeline)>,
}

impl LeafPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        species_table: &SpeciesTable,
        cull: &CullPass,
    ) -> Self {
        let pipeline = |label, name, records| {
            let shader = compile(device, &super::shaders(), name);
            ScenePipeline {
                label,
                frame,
                groups: &[&light.layout, &species_table.layout, records],
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                culls_back: false,
                shader: &shader,
                vertex: "vertex",
                constants: &[
                    ("IS_PAINTED", f64::from(u8::from(cull.is_painted))),
                    ("LEAVES_BURN", f64::from(u8::from(species_table.leaves_burn))),
                ],
                buffers: &[VisibleLeaves::layout()],
                blend: None,
                depth_write: true,
                alpha_to_coverage: false,
            }
            .build(device)
        };
        Self {
            fine: pipeline("leaves", "leaves/leaf_pass", &cull.page_layouts.records),
            small: (!species_table.leaves_burn).then(|| {
                let records = &cull.page_layouts.lit_records;
                let lighting = SmallLeafLight::new(device, frame, light, species_table, cull);
                (lighting, pipeline("small leaves", "leaves/small_leaf_pass", records))
            }),
        }
    }

    /// Finds the light on small leaves as the last culling left them; groups are those of a frame and of light.
    pub(crate) fn light<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        [frame, light]: [&wgpu::BindGroup; 2],
        species_table: &SpeciesTable,
        visible: impl Iterator<Item = &'a VisibleLeaves>,
    ) {
        if let Some((lighting, _)) = &self.small {
            lighting.run(encoder, [frame, light, &species_table.group], visible);
        }
    }

    /// Draws leaves as the last culling left them; bind groups 0 and 1 are set.
    pub(crate) fn draw<'a>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        species_table: &SpeciesTable,
        visible: impl Iterator<Item = &'a VisibleLeaves> + Clone,
    ) {
        pass.set_pipeline(&self.fine);
        pass.set_bind_group(2, &species_table.group, &[]);
        let levels = if self.small.is_some() { 1..LEVELS } else { 0..LEVELS };
        for leaves in visible.clone() {
            leaves.draw(pass, levels.clone());
        }
        if let Some((_, pipeline)) = &self.small {
            pass.set_pipeline(pipeline);
            for leaves in visible {
                leaves.draw_lit(pass);
            }
        }
    }
}
