// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/fly.wgsl
//!
//! Moves the leaves of a chunk that fly as bodies through one step.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::fly::leaf_fly;
use windfall_core::leaf::LeavesMut;

use super::resolve_events::EventList;
use crate::quiet::UNIT;
use crate::simd::flying_block::FlyingBlock;
use crate::simd::{Simd, in_packs};

/// Steps the bodies of one chunk, in the units that `advance` has not passed by.
pub(crate) fn fly(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList, simd: Simd) {
    match simd {
        Simd::Scalar => {
            let count = leaves.len();
            for slot in events.stepped().flat_map(|unit| slots_of(unit, count)) {
                leaf_fly(cx, &mut leaves.row_mut(slot));
            }
        }
        Simd::Lanes(level) => in_packs!(level, fly_lanes(cx, leaves, events)),
    }
}

/// Slots of a unit in a chunk of so many.
fn slots_of(unit: usize, count: usize) -> Range<usize> {
    unit * UNIT..count.min((unit + 1) * UNIT)
}

/// Steps the bodies of units block by block; those that land, and the last few slots, one by one.
#[inline(always)]
fn fly_lanes<P: Pack>(simd: P::Simd, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList) {
    for unit in events.stepped() {
        let slots = slots_of(unit, leaves.len());
        let few = slots.end - slots.len() % BLOCK;
        for first in (slots.start..few).step_by(BLOCK) {
            let mut landing = block_of(leaves, first).fly::<P>(simd, cx);
            while landing != 0 {
                leaf_fly(cx, &mut leaves.row_mut(first + landing.trailing_zeros() as usize));
                landing &= landing - 1;
            }
        }
        for slot in few..slots.end {
            leaf_fly(cx, &mut leaves.row_mut(slot));
        }
    }
}

/// The block of slots from one on.
#[inline(always)]
fn block_of<'a>(leaves: &'a mut LeavesMut<'_>, first: usize) -> FlyingBlock<'a> {
    FlyingBlock {
        place: block_in(leaves.place, first),
        drift: block_in(leaves.drift, first),
        attitude: block_in(leaves.attitude, first),
        schedule: block_in(leaves.schedule, first),
        identity: block_in(leaves.identity, first),
    }
}

/// Records of a column from a slot on.
#[inline(always)]
fn block_in<T>(column: &mut [T], first: usize) -> &mut [T; BLOCK] {
    column[first..].first_chunk_mut().expect("as many slots are left")
}
