// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_fold.wgsl
//!
//! The pass towards the foot: what every joint of a stand hands down, and how it will answer.

use fearless_simd::dispatch;
use windfall_core::Context;
use windfall_core::tree::forest::Stand;
use windfall_core::tree::sway::row::{Rows, row_fold};

use super::sway_eight::fold_eight;
use super::timber_eight::{AnswerEight, StandEight};
use crate::simd::Simd;

/// A stand, from the tips to the trunks.
pub(crate) fn sway_fold(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    stand: &Stand,
    eights: &StandEight,
    answers: &mut [AnswerEight],
    simd: Simd,
) {
    let mut single = stand.len();
    if let Simd::Lanes(simd) = simd {
        dispatch!(simd, simd => fold_lanes(simd, cx, rows, eights, answers));
        // Trunks grow from the ground, which no row holds.
        single = eights.blocks.first().map_or(single, |block| block.row);
    }
    for row in (0..single).rev() {
        row_fold(cx, rows, row);
    }
}

/// All blocks above the trunks.
#[inline(always)]
fn fold_lanes<S: fearless_simd::Simd>(
    simd: S,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    eights: &StandEight,
    answers: &mut [AnswerEight],
) {
    for (block, kept) in eights.blocks.iter().zip(answers).rev() {
        fold_eight(simd, cx, rows, block, eights.children(block), kept);
    }
}
