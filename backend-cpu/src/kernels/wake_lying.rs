// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/wake_lying.wgsl
//!
//! Wakes leaves of a chunk that lie in the litter: those in the way of solid parts that move, and, in units that have their turn, those
//! that the wind takes. Those afloat it sets drifting.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::record::{is_covered, lies_still};
use windfall_core::device::leaf::stack::leaf_changes_litter;
use windfall_core::device::leaf::strike::leaf_push;
use windfall_core::device::leaf::wake::{cover_is_due, leaf_check_cover, leaf_wake, wake_is_due};
use windfall_core::leaf::LeavesMut;

use crate::exposed::ExposedLeaves;
use crate::quiet::UNIT;
use crate::simd::branch_block::word;
use crate::simd::lying_block::LyingBlock;
use crate::simd::{Simd, in_packs};

/// Wakes leaves of a chunk that begins with slot `first`, and lists them.
pub(crate) fn wake_lying(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    first: usize,
    exposed: &ExposedLeaves,
    changing: &mut Vec<usize>,
    simd: Simd,
) {
    let movers = cx.scene.solids.mover_count;
    for unit in (0..leaves.len()).step_by(UNIT) {
        if movers != 0 {
            match simd {
                Simd::Scalar => {
                    let slots = unit..leaves.len().min(unit + UNIT);
                    push_slots(cx, leaves, slots, changing);
                }
                Simd::Lanes(level) => in_packs!(level, push_lanes(cx, leaves, unit, changing)),
            }
        }
        if !wake_is_due(cx, word(first + unit)) {
            continue;
        }
        if cover_is_due(cx, word(first + unit)) {
            let bits = match simd {
                Simd::Scalar => check_each(cx, leaves, unit, changing),
                Simd::Lanes(level) => in_packs!(level, check_lanes(cx, leaves, unit, changing)),
            };
            exposed.set(first + unit, bits);
        }
        let mut waking = if cx.scene.is_calm() { 0 } else { exposed.of_unit(first + unit) };
        if let Simd::Lanes(level) = simd
            && waking != 0
        {
            waking = in_packs!(level, sample_lanes(cx, leaves, unit, waking));
        }
        while waking != 0 {
            let slot = unit + waking.trailing_zeros() as usize;
            if slot < leaves.len() && leaf_wake(cx, &mut leaves.row_mut(slot)) {
                changing.push(slot);
            }
            waking &= waking - 1;
        }
    }
}

/// Wakes those of some slots that solid parts which move come upon.
fn push_slots(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, slots: Range<usize>, changing: &mut Vec<usize>) {
    for slot in slots {
        // What drifts is listed.
        let is_listed = leaf_changes_litter(leaves.place[slot].bits, leaves.drift[slot].velocity.into());
        if leaf_push(cx, &mut leaves.row_mut(slot)) && !is_listed {
            changing.push(slot);
        }
    }
}

/// The same for a unit block by block, the last few slots one by one.
#[inline(always)]
fn push_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    unit: usize,
    changing: &mut Vec<usize>,
) {
    let end = leaves.len().min(unit + UNIT);
    let few = end - (end - unit) % BLOCK;
    for first in (unit..few).step_by(BLOCK) {
        let mut near = block_of(leaves, first).meet_movers::<P>(simd, cx);
        while near != 0 {
            let slot = first + near.trailing_zeros() as usize;
            push_slots(cx, leaves, slot..slot + 1, changing);
            near &= near - 1;
        }
    }
    push_slots(cx, leaves, few..end, changing);
}

/// Checks the covers of a unit one leaf after another. A bit for each that lies with nothing on it.
fn check_each(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, unit: usize, changing: &mut Vec<usize>) -> u64 {
    check_slots(cx, leaves, unit, unit..leaves.len().min(unit + UNIT), changing)
}

/// The same for some of its slots.
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

/// The same block by block, the last few slots one by one.
#[inline(always)]
fn check_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    unit: usize,
    changing: &mut Vec<usize>,
) -> u64 {
    let end = leaves.len().min(unit + UNIT);
    let few = end - (end - unit) % BLOCK;
    let mut exposed = 0;
    for first in (unit..few).step_by(BLOCK) {
        let covers = block_of(leaves, first).check_cover::<P>(simd, cx);
        exposed |= u64::from(covers.exposed) << (first - unit);
        let mut loose = covers.loose;
        while loose != 0 {
            let slot = first + loose.trailing_zeros() as usize;
            leaf_check_cover(cx, &mut leaves.row_mut(slot));
            changing.push(slot);
            loose &= loose - 1;
        }
    }
    exposed | check_slots(cx, leaves, unit, few..end, changing)
}

/// Of the leaves of a unit with a bit in `waking` those that the wind may take; the last few slots unseen.
#[inline(always)]
fn sample_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    unit: usize,
    waking: u64,
) -> u64 {
    let mut left = waking;
    let end = leaves.len().min(unit + UNIT);
    for first in (unit..end - (end - unit) % BLOCK).step_by(BLOCK) {
        let of_block = ((1 << BLOCK) - 1) << (first - unit);
        if waking & of_block != 0 {
            let may_wake = u64::from(block_of(leaves, first).sample_wind::<P>(simd, cx));
            left &= !of_block | (may_wake << (first - unit));
        }
    }
    left
}

/// The block of slots from one on.
#[inline(always)]
fn block_of<'a>(leaves: &'a mut LeavesMut<'_>, first: usize) -> LyingBlock<'a> {
    let whole = "as many slots are left";
    LyingBlock {
        place: leaves.place[first..].first_chunk_mut().expect(whole),
        drift: leaves.drift[first..].first_chunk().expect(whole),
        schedule: leaves.schedule[first..].first_chunk().expect(whole),
    }
}
