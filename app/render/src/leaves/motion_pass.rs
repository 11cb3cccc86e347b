// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws how far leaves move over the picture while the shutter is open, from where they were a frame before.

use windfall_wgpu::LeafColumns;

use super::previous::PreviousLeaves;
use super::species_table::SpeciesTable;
use super::visible::VisibleLeaves;
use crate::frame::group::FrameGroup;
use crate::gpu::pipeline::buffer_entry;
use crate::gpu::shaders::compile;
use crate::lens::motion::Motion;

/// The pipeline, and where the leaves were.
#[derive(Debug)]
pub(crate) struct MotionPass {
    pipeline: wgpu::RenderPipeline,
    columns_layout: wgpu::BindGroupLayout,
    pub(crate) past: PreviousLeaves,
}

impl MotionPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        motion: &Motion,
        species_table: &SpeciesTable,
        leaf_count: u32,
    ) -> Self {
        let vertex = wgpu::ShaderStages::VERTEX;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let columns_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("moving leaves"),
            entries: &[0, 1, 2, 3, 4].map(|binding| buffer_entry(binding, read, vertex)),
        });
        let module = compile(device, &super::shaders(), "leaves/motion_pass");
        let pipeline = motion.pipeline(
            device,
            ("leaf motion", frame, &module),
            &[&species_table.layout, &columns_layout],
            wgpu::PrimitiveTopology::TriangleStrip,
            VisibleLeaves::layout(),
        );
        Self { pipeline, columns_layout, past: PreviousLeaves::new(device, leaf_count) }
    }

    /// Draws the ways of `visible` leaves in a pass that [`Motion::begin`] has begun; their culling has been done.
    pub(crate) fn draw(
        &self,
        device: &wgpu::Device,
        pass: &mut wgpu::RenderPass<'_>,
        (species_table, visible): (&SpeciesTable, &VisibleLeaves),
        leaves: &LeafColumns<'_>,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &species_table.group, &[]);
        let columns = [leaves.place, leaves.attitude, &self.past.place, &self.past.attitude];
        visible.draw_with(device, pass, &self.columns_layout, columns, leaves.leaf_count);
    }
}
