// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_gather.wgsl
//!
//! Inward pass of the schemes that step joints one by one: composite bodies of segments and what grows from them.

use windfall_core::Context;
use windfall_core::device::tree::sway::row::{Rows, row_gather};

/// Steps a batch from the twigs to the trunks.
pub(crate) fn sway_gather(cx: &Context<'_>, rows: &mut Rows<'_>) {
    for row in (0..rows.segments.len()).rev() {
        row_gather(cx, rows, row);
    }
}
