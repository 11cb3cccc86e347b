// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light on leaves of a few pixels, found once for each before they are drawn.

use super::cull::CullPass;
use super::page::Page;
use super::record::CULL_GROUP_SIZE;
use super::species_table::SpeciesTable;
use super::visible::VisibleLeaves;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::gpu::pipeline::layout;
use crate::gpu::shaders::compile;

/// Most workgroups: enough to fill a large device.
const MAX_GROUPS: u32 = 1024;

/// The pipeline.
#[derive(Debug)]
pub(crate) struct SmallLeafLight {
    pipeline: wgpu::ComputePipeline,
}

impl SmallLeafLight {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        species_table: &SpeciesTable,
        cull: &CullPass,
    ) -> Self {
        let module = compile(device, &super::shaders(), "leaves/small_leaf_light");
        let groups =
            [&frame.layout, &light.layout, &species_table.layout, &cull.page_layouts.lighting].map(Some);
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("light on small leaves"),
            layout: Some(&layout(device, &groups)),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &frame.overrides(),
                ..Default::default()
            },
            cache: None,
        });
        Self { pipeline }
    }

    /// Finds the light on the small leaves that the last culling left.
    pub(crate) fn run<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        groups: [&wgpu::BindGroup; 3],
        visible: impl Iterator<Item = &'a VisibleLeaves>,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("light on small leaves"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        for (number, group) in (0u32..).zip(groups) {
            pass.set_bind_group(number, group, &[]);
        }
        for page in visible.flat_map(|leaves| &leaves.pages) {
            pass.set_bind_group(3, &page.lighting, &[]);
            pass.dispatch_workgroups(workgroups(page), 1, 1);
        }
    }
}

/// Workgroups for the leaves that may be drawn of a page.
fn workgroups(page: &Page) -> u32 {
    page.most_records.div_ceil(CULL_GROUP_SIZE).clamp(1, MAX_GROUPS)
}
