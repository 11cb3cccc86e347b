// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_fold.wgsl
//!
//! The pass towards the foot: what every joint of a level hands down, and how it will answer.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::tree::sway::row::{Rows, row_fold};

/// One level of a stand.
pub(crate) fn sway_fold(cx: &Context<'_>, rows: &mut Rows<'_>, level: Range<usize>) {
    for row in level {
        row_fold(cx, rows, row);
    }
}
