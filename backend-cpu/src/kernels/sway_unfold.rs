// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_unfold.wgsl
//!
//! The pass towards the tips: every joint of a stand moves on.

use windfall_core::Context;
use windfall_core::kernel::pack::{BLOCK, Pack};
use windfall_core::tree::sway::row::{Rows, row_unfold};

use super::fetch::AHEAD;
use super::scratch::BlockScratch;
use super::sway_block::Step;
use super::timber_block::{StandBlocks, UNFOLDED};
use crate::simd::{Simd, in_packs};

/// A stand, from the trunks to the tips.
pub(crate) fn sway_unfold(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &StandBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.timber.len()).for_each(|row| row_unfold(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = Step { cx, rows, blocks };
            in_packs!(level, unfold_lanes(step, scratch));
        }
    }
}

/// All blocks.
#[inline(always)]
fn unfold_lanes<P: Pack>(simd: P::Simd, mut step: Step<'_, '_>, scratch: &mut BlockScratch) {
    for number in (0..step.blocks.limbs.len()).rev() {
        if let Some(ahead) = number.checked_sub(AHEAD) {
            step.fetch(ahead, UNFOLDED);
        }
        for part in 0..BLOCK / P::LANES {
            step.unfold::<P>(simd, number, part, scratch);
        }
    }
}
