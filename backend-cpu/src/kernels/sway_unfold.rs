// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_unfold.wgsl
//!
//! The pass towards the tips: every joint of a stand moves on.

use fearless_simd::dispatch;
use windfall_core::Context;
use windfall_core::tree::forest::Stand;
use windfall_core::tree::sway::row::{Rows, row_unfold};

use super::sway_eight::unfold_eight;
use super::timber_eight::{AnswerEight, StandEight};
use crate::simd::Simd;

/// A stand, from the trunks to the tips.
pub(crate) fn sway_unfold(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    stand: &Stand,
    eights: &StandEight,
    answers: &[AnswerEight],
    simd: Simd,
) {
    let mut single = stand.len();
    if let Simd::Lanes(_) = simd {
        // Trunks grow from the ground, which no row holds.
        single = eights.blocks.first().map_or(single, |block| block.row);
    }
    for row in 0..single {
        row_unfold(cx, rows, row);
    }
    if let Simd::Lanes(simd) = simd {
        dispatch!(simd, simd => unfold_lanes(simd, cx, rows, eights, answers));
    }
}

/// All blocks above the trunks.
#[inline(always)]
fn unfold_lanes<S: fearless_simd::Simd>(
    simd: S,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    eights: &StandEight,
    answers: &[AnswerEight],
) {
    for (block, kept) in eights.blocks.iter().zip(answers) {
        unfold_eight(simd, cx, rows, block, kept);
    }
}
