// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/check_cover.wgsl
//!
//! Sees what lies on and beneath the leaves of a chunk that lie in the litter, in units that have their turn: those that have lost their
//! support leave it.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::record::{is_covered, lies_still};
use windfall_core::device::leaf::wake::{cover_is_due, leaf_check_cover};
use windfall_core::leaf::LeavesMut;

use crate::exposed::ExposedLeaves;
use crate::quiet::{UNIT, places_of};
use crate::simd::branch_block::word;
use crate::simd::lying_block::lying_block;
use crate::simd::{Simd, in_packs};

/// Checks leaves of a chunk that begins with slot `first`, lists those that leave, and notes which are exposed.
pub(crate) fn check_cover(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    first: usize,
    exposed: &ExposedLeaves,
    changing: &mut Vec<usize>,
    simd: Simd,
) {
    for unit in (0..leaves.len()).step_by(UNIT).filter(|unit| cover_is_due(cx, word(first + unit))) {
        let slots = unit..leaves.len().min(unit + UNIT);
        let bits = match simd {
            Simd::Scalar => check_slots(cx, leaves, unit, slots, changing),
            Simd::Lanes(level) => in_packs!(level, check_lanes(cx, leaves, slots, changing)),
        };
        exposed.set(first + unit, bits);
    }
}

/// Checks some slots of a unit one after another. A bit for each leaf that lies with nothing on it.
fn check_slots(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    unit: usize,
    slots: Range<usize>,
    changing: &mut Vec<usize>,
) -> u64 {
    let mut exposed = 0;
    for slot in slots {
        if leaf_check_cover(cx, &mut leaves.row_mut(slot)) {
            changing.push(slot);
        }
        let bits = leaves.place[slot].bits;
        exposed |= u64::from(lies_still(bits) && !is_covered(bits)) << (slot - unit);
    }
    exposed
}

/// The same for a whole unit block by block, the last few slots one by one.
#[inline(always)]
fn check_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    slots: Range<usize>,
    changing: &mut Vec<usize>,
) -> u64 {
    let (unit, few) = (slots.start, slots.end - slots.len() % BLOCK);
    let mut exposed = 0;
    for first in (unit..few).step_by(BLOCK) {
        let covers = lying_block(leaves, first).check_cover::<P>(simd, cx);
        exposed |= u64::from(covers.exposed) << (first - unit);
        for place in places_of(covers.loose.into()) {
            leaf_check_cover(cx, &mut leaves.row_mut(first + place));
            changing.push(first + place);
        }
    }
    exposed | check_slots(cx, leaves, unit, few..slots.end, changing)
}
