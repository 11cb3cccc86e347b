// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_coast.wgsl
//!
//! Step of a batch of trees between two solutions of their joints.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::tree::sway::coast::segment_coast;
use windfall_core::device::tree::sway::row::{Rows, row_coast};

use crate::simd::branch_block::change_places;
use crate::simd::{Simd, in_packs};

/// Moves all segments of a batch on.
pub(crate) fn sway_coast(cx: &Context<'_>, rows: &mut Rows<'_>, simd: Simd) {
    let in_blocks = match simd {
        Simd::Scalar => 0,
        Simd::Lanes(level) => in_packs!(level, coast_lanes(cx, rows)),
    };
    (in_blocks..rows.segments.len()).for_each(|row| row_coast(cx, rows, row));
}

/// Moves full blocks of rows, whatever grows where, and returns the number of rows in them.
#[inline(always)]
fn coast_lanes<P: Pack>(simd: P::Simd, cx: &Context<'_>, rows: &mut Rows<'_>) -> usize {
    let in_blocks = rows.segments.len() / BLOCK * BLOCK;
    for first in (0..in_blocks).step_by(BLOCK) {
        for part in 0..BLOCK / P::LANES {
            change_places::<P>(
                simd,
                &mut rows.branches,
                (first, part),
                #[inline(always)]
                |body| segment_coast(cx, body),
            );
        }
    }
    in_blocks
}
