// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_follow.wgsl
//!
//! The pass towards the tips of the same schemes: every joint moves on.

use windfall_core::Context;
use windfall_core::device::tree::sway::row::{Rows, row_follow};

/// A batch, from the trunks to the tips.
pub(crate) fn sway_follow(cx: &Context<'_>, rows: &mut Rows<'_>) {
    for row in 0..rows.segments.len() {
        row_follow(cx, rows, row);
    }
}
