// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_fold.wgsl
//!
//! The pass towards the foot: what every joint of a stand hands down, and how it will answer.

use windfall_core::Context;
use windfall_core::kernel::pack::{BLOCK, Pack};
use windfall_core::tree::sway::row::{Rows, row_fold};

use super::fetch::AHEAD;
use super::scratch::BlockScratch;
use super::sway_block::Step;
use super::timber_block::{FOLDED, StandBlocks};
use crate::simd::{Simd, in_packs};

/// A stand, from the tips to the trunks.
pub(crate) fn sway_fold(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &StandBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.timber.len()).rev().for_each(|row| row_fold(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = Step { cx, rows, blocks };
            in_packs!(level, fold_lanes(step, scratch));
        }
    }
}

/// All blocks.
#[inline(always)]
fn fold_lanes<P: Pack>(simd: P::Simd, step: Step<'_, '_>, scratch: &mut BlockScratch) {
    for number in 0..step.blocks.limbs.len() {
        step.fetch(number + AHEAD, FOLDED);
        for part in 0..BLOCK / P::LANES {
            step.fold::<P>(simd, number, part, scratch);
        }
    }
}
