// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_outward.wgsl
//!
//! The pass towards the tips: every joint of a batch moves on.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::tree::sway::row::{Rows, row_outward};

use super::fetch::AHEAD;
use super::scratch::BlockScratch;
use super::segment_block::{BatchBlocks, OUTWARD};
use super::sway_block::Step;
use crate::simd::{Simd, in_packs};

/// A batch, from the trunks to the tips.
pub(crate) fn sway_outward(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &BatchBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.segments.len()).for_each(|row| row_outward(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = Step { cx, rows, blocks };
            in_packs!(level, outward_lanes(step, scratch));
        }
    }
}

/// All blocks.
#[inline(always)]
fn outward_lanes<P: Pack>(simd: P::Simd, mut step: Step<'_, '_>, scratch: &mut BlockScratch) {
    for number in (0..step.blocks.limbs.len()).rev() {
        if let Some(ahead) = number.checked_sub(AHEAD) {
            step.fetch(ahead, OUTWARD);
        }
        for part in 0..BLOCK / P::LANES {
            step.outward::<P>(simd, number, part, scratch);
        }
    }
}
