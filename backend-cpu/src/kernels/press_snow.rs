// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/press_snow.wgsl
//!
//! Presses the snow beneath things that move, in the steps in which they do.

use windfall_core::Context;
use windfall_core::device::terrain::snow_print::snow_is_pressed;
use windfall_core::litter::Bed;

/// Takes the cells beneath things that move through a step. They are so few that one thread does.
pub(crate) fn press_snow(cx: &Context<'_>, bed: &mut Bed) {
    if cx.scene.has_movers() && snow_is_pressed(cx.step.index) {
        bed.snow_mut(cx.scene).press(cx);
    }
}
