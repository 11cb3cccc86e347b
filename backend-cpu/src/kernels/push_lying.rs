// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/push_lying.wgsl
//!
//! Wakes leaves of a chunk that lie in the litter in the way of solid parts that move. Only where some move.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::stack::leaf_changes_litter;
use windfall_core::device::leaf::strike::leaf_push;
use windfall_core::leaf::LeavesMut;

use crate::quiet::places_of;
use crate::simd::lying_block::lying_block;
use crate::simd::{Simd, in_packs};

/// Wakes leaves of a chunk, and lists them.
pub(crate) fn push_lying(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    changing: &mut Vec<usize>,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => push_slots(cx, leaves, 0..leaves.len(), changing),
        Simd::Lanes(level) => in_packs!(level, push_lanes(cx, leaves, changing)),
    }
}

/// Wakes those of some slots that solid parts come upon.
fn push_slots(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, slots: Range<usize>, changing: &mut Vec<usize>) {
    for slot in slots {
        // What drifts is listed.
        let is_listed = leaf_changes_litter(leaves.place[slot].bits, leaves.drift[slot].velocity.into());
        if leaf_push(cx, &mut leaves.row_mut(slot)) && !is_listed {
            changing.push(slot);
        }
    }
}

/// The same block by block, the last few slots one by one.
#[inline(always)]
fn push_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    changing: &mut Vec<usize>,
) {
    let few = leaves.len() - leaves.len() % BLOCK;
    for first in (0..few).step_by(BLOCK) {
        let near = lying_block(leaves, first).meet_movers::<P>(simd, cx);
        for place in places_of(near.into()) {
            push_slots(cx, leaves, first + place..first + place + 1, changing);
        }
    }
    push_slots(cx, leaves, few..leaves.len(), changing);
}
