// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shows how densely leaves lie on the ground: lays colours over the land.

use super::landing_count::{CELLS, LandingCount};
use super::overlay::Overlay;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;

/// The counts, and the pipeline that shows them.
#[derive(Debug)]
pub(crate) struct LandingPass {
    pub(crate) count: LandingCount,
    overlay: Overlay,
}

impl LandingPass {
    /// Shows `count`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        count: LandingCount,
    ) -> Self {
        let buffers = [&count.uniform, &count.cells];
        let overlay = Overlay::new(device, (frame, light), "landings", "marks/landing_pass", buffers);
        Self { count, overlay }
    }

    /// Lays the colours over the ground; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.overlay.draw(pass, 6, CELLS * CELLS);
    }
}
