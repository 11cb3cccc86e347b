// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_follow.wgsl
//!
//! The pass towards the tips of the same schemes: every joint of a level moves on.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::tree::sway::row::{Rows, row_follow};

/// One level of a stand.
pub(crate) fn sway_follow(cx: &Context<'_>, rows: &mut Rows<'_>, level: Range<usize>) {
    for row in level {
        row_follow(cx, rows, row);
    }
}
