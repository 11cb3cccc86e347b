// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_fold.wgsl
//!
//! The pass towards the foot: what every joint of a level hands down, and how it will answer.

use std::ops::Range;

use fearless_simd::dispatch;
use windfall_core::Context;
use windfall_core::kernel::lane::LANES;
use windfall_core::tree::sway::row::{Rows, row_fold};

use super::sway_eight::fold_eight;
use crate::simd::Simd;

/// One level of a stand.
pub(crate) fn sway_fold(cx: &Context<'_>, rows: &mut Rows<'_>, level: Range<usize>, simd: Simd) {
    let mut row = level.start;
    // Trunks, the first level, grow from the ground, which no row holds.
    if let Simd::Lanes(simd) = simd
        && level.start > 0
    {
        let whole = level.len() / LANES * LANES;
        dispatch!(simd, simd => fold_lanes(simd, cx, rows, level.start..level.start + whole));
        row += whole;
    }
    for row in row..level.end {
        row_fold(cx, rows, row);
    }
}

/// Eight rows at a time; the run is a multiple of eight long.
#[inline(always)]
fn fold_lanes<S: fearless_simd::Simd>(simd: S, cx: &Context<'_>, rows: &mut Rows<'_>, run: Range<usize>) {
    for row in run.step_by(LANES) {
        fold_eight(simd, cx, rows, row);
    }
}
