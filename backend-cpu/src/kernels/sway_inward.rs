// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_inward.wgsl
//!
//! The pass towards the foot: what every joint of a batch hands down, and how it will answer.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::tree::sway::row::{Rows, row_inward};

use super::fetch::AHEAD;
use super::scratch::BlockScratch;
use super::segment_block::{BatchBlocks, INWARD};
use super::sway_block::Step;
use crate::simd::{Simd, in_packs};

/// A batch, from the tips to the trunks.
pub(crate) fn sway_inward(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &BatchBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.segments.len()).rev().for_each(|row| row_inward(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = Step { cx, rows, blocks };
            in_packs!(level, inward_lanes(step, scratch));
        }
    }
}

/// All blocks.
#[inline(always)]
fn inward_lanes<P: Pack>(simd: P::Simd, step: Step<'_, '_>, scratch: &mut BlockScratch) {
    for number in 0..step.blocks.limbs.len() {
        step.fetch(number + AHEAD, INWARD);
        for part in 0..BLOCK / P::LANES {
            step.inward::<P>(simd, number, part, scratch);
        }
    }
}
