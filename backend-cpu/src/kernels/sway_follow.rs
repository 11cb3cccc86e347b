// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_follow.wgsl
//!
//! Outward pass of the schemes that step joints one by one: the integration of joints.

use windfall_core::Context;
use windfall_core::device::tree::sway::row::{Rows, row_follow};

/// Steps a batch from the trunks to the twigs.
pub(crate) fn sway_follow(cx: &Context<'_>, rows: &mut Rows<'_>) {
    for row in 0..rows.segments.len() {
        row_follow(cx, rows, row);
    }
}
