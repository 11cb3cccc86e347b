// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws how far objects and those who walk move over the picture while the shutter is open.

use super::records::ObjectBuffers;
use crate::frame::group::FrameGroup;
use crate::gpu::shaders::compile;
use crate::lens::motion::Motion;

/// The pipeline of objects that move.
#[derive(Debug)]
pub(crate) struct ObjectMotionPass {
    pipeline: wgpu::RenderPipeline,
}

impl ObjectMotionPass {
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        motion: &Motion,
        objects: &ObjectBuffers,
    ) -> Self {
        let module = compile(device, &super::shaders(), "objects/motion_pass");
        let pipeline = motion.pipeline(
            device,
            ("object motion", frame, &module),
            &[&objects.layout],
            wgpu::PrimitiveTopology::TriangleList,
            ObjectBuffers::vertex_layout(),
        );
        Self { pipeline }
    }

    /// Draws the ways of all parts that ever move in a pass that [`Motion::begin`] has begun.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, objects: &ObjectBuffers) {
        pass.set_pipeline(&self.pipeline);
        objects.draw_moving(pass);
    }
}
