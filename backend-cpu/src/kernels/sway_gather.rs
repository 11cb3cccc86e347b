// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_gather.wgsl
//!
//! The pass towards the foot of the schemes that move joints one by one: what every segment carries.

use windfall_core::Context;
use windfall_core::device::tree::sway::row::{Rows, row_gather};

/// A batch, from the tips to the trunks.
pub(crate) fn sway_gather(cx: &Context<'_>, rows: &mut Rows<'_>) {
    for row in (0..rows.segments.len()).rev() {
        row_gather(cx, rows, row);
    }
}
