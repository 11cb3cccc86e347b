// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/fly.wgsl
//!
//! Moves the leaves of a chunk that fly as bodies through one step.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::fly::leaf_fly;
use windfall_core::device::leaf::record::flies;
use windfall_core::leaf::{Attitude, Drift, Identity, LeavesMut, Place, Schedule};

use super::CHUNK;
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

/// Bodies of a block from which on it is stepped where it lies. Blocks with fewer share registers: where a few leaves of the litter
/// are awake among many that lie, most lanes would be idle.
const DENSE: u32 = 8;

/// Steps the bodies of units block by block; those that land, and the last few slots, one by one.
#[inline(always)]
fn fly_lanes<P: Pack>(simd: P::Simd, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList) {
    let mut few = [0; CHUNK / BLOCK];
    for unit in events.stepped() {
        let slots = slots_of(unit, leaves.len());
        let whole = slots.end - slots.len() % BLOCK;
        for first in (slots.start..whole).step_by(BLOCK) {
            let awake = bodies_in(leaves, first);
            if awake.count_ones() >= DENSE {
                let landing = block_of(leaves, first).fly::<P>(simd, cx);
                places_of(landing).for_each(|place| leaf_fly(cx, &mut leaves.row_mut(first + place)));
            } else {
                few[first / BLOCK] = awake;
            }
        }
        for slot in whole..slots.end {
            leaf_fly(cx, &mut leaves.row_mut(slot));
        }
    }
    let blocks = few.into_iter().enumerate();
    let mut few = blocks.flat_map(|(block, awake)| places_of(awake).map(move |place| block * BLOCK + place));
    loop {
        let (mut slots, mut count) = ([0; BLOCK], 0);
        for (to, slot) in slots.iter_mut().zip(few.by_ref()) {
            *to = slot;
            count += 1;
        }
        if count == 0 {
            break;
        }
        fly_gathered::<P>(simd, cx, leaves, &slots[..count]);
    }
}

/// Places of the bits.
#[inline(always)]
fn places_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        place
    })
}

/// A bit for each leaf of a block that flies as a body.
#[inline(always)]
fn bodies_in(leaves: &LeavesMut<'_>, first: usize) -> u32 {
    let places = leaves.place[first..].iter().take(BLOCK);
    (0..).zip(places).fold(0, |bits, (place, of)| bits | (u32::from(flies(of.bits)) << place))
}

/// Steps bodies from here and there side by side, at most as many as a block has.
#[inline(always)]
fn fly_gathered<P: Pack>(simd: P::Simd, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, slots: &[usize]) {
    let mut place = [Place::default(); BLOCK];
    let mut drift = [Drift::default(); BLOCK];
    let mut attitude = [Attitude::default(); BLOCK];
    let mut schedule = [Schedule::default(); BLOCK];
    let mut identity = [Identity::default(); BLOCK];
    for (at, &slot) in slots.iter().enumerate() {
        place[at] = leaves.place[slot];
        drift[at] = leaves.drift[slot];
        attitude[at] = leaves.attitude[slot];
        schedule[at] = leaves.schedule[slot];
        identity[at] = leaves.identity[slot];
    }
    let mut block = FlyingBlock {
        place: &mut place,
        drift: &mut drift,
        attitude: &mut attitude,
        schedule: &mut schedule,
        identity: &mut identity,
    };
    let landing = block.fly::<P>(simd, cx);
    for (at, &slot) in slots.iter().enumerate() {
        leaves.place[slot] = place[at];
        leaves.drift[slot] = drift[at];
        leaves.attitude[slot] = attitude[at];
        leaves.schedule[slot] = schedule[at];
        leaves.identity[slot] = identity[at];
    }
    places_of(landing).for_each(|at| leaf_fly(cx, &mut leaves.row_mut(slots[at])));
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
