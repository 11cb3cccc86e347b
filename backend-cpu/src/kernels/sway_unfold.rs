// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_unfold.wgsl
//!
//! The pass towards the tips: every joint of a level moves on.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::tree::sway::row::{Rows, row_unfold};

/// One level of a stand.
pub(crate) fn sway_unfold(cx: &Context<'_>, rows: &mut Rows<'_>, level: Range<usize>) {
    for row in level {
        row_unfold(cx, rows, row);
    }
}
