// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_gather.wgsl
//!
//! The pass towards the foot of the schemes that move joints one by one: what every segment of a level carries.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::tree::sway::row::{Rows, row_gather};

/// One level of a stand.
pub(crate) fn sway_gather(cx: &Context<'_>, rows: &mut Rows<'_>, level: Range<usize>) {
    for row in level {
        row_gather(cx, rows, row);
    }
}
