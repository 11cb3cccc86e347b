// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/wake_lying.wgsl
//!
//! Wakes leaves of a chunk that lie in the litter and that the wind takes, in units that have their turn. Those afloat it sets drifting. Only
//! where it blows.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::wake::{leaf_wake, wake_is_due};
use windfall_core::leaf::{Drift, LeavesMut, Place, Schedule};

use super::CHUNK;
use super::fly::{DENSE, FewOfBlocks, next_few, slots_of};
use super::resolve_events::bits_of_block;
use crate::exposed::ExposedLeaves;
use crate::quiet::{UNIT, places_of};
use crate::simd::branch_block::word;
use crate::simd::lying_block::{LyingBlock, lying_block};
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
    let units = (0..leaves.len()).step_by(UNIT).filter(|unit| wake_is_due(cx, word(first + unit)));
    let units = units.map(|unit| (unit, exposed.of_unit(first + unit)));
    match simd {
        Simd::Scalar => {
            for (unit, bits) in units {
                wake_slots(cx, leaves, places_of(bits).map(|place| unit + place), changing);
            }
        }
        Simd::Lanes(level) => in_packs!(level, wake_lanes(cx, leaves, units, changing)),
    }
}

/// Wakes leaves one after another.
#[inline(never)]
fn wake_slots(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    slots: impl Iterator<Item = usize>,
    changing: &mut Vec<usize>,
) {
    for slot in slots {
        if slot < leaves.len() && leaf_wake(cx, &mut leaves.row_mut(slot)) {
            changing.push(slot);
        }
    }
}

/// Samples the wind at the exposed leaves of units block by block, the last few slots one by one, and wakes those that it may take. Those of
/// blocks with few of them share registers: in deep litter most leaves of a block are covered.
#[inline(always)]
fn wake_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    units: impl Iterator<Item = (usize, u64)>,
    changing: &mut Vec<usize>,
) {
    let mut few: FewOfBlocks = [0; CHUNK / BLOCK];
    let mut waking: FewOfBlocks = [0; CHUNK / BLOCK];
    let blocks = units.flat_map(|(unit, bits)| {
        (0..UNIT / BLOCK).map(move |block| (unit / BLOCK + block, bits_of_block(bits, block)))
    });
    for (block, bits) in blocks.filter(|&(_, bits)| bits != 0) {
        let first = block * BLOCK;
        if leaves.len() < first + BLOCK {
            waking[block] = bits;
        } else if bits.count_ones() >= DENSE {
            waking[block] = lying_block(leaves, first).sample_wind::<P>(simd, cx) & bits;
        } else {
            few[block] = bits;
        }
    }
    let mut slots = slots_of(few);
    loop {
        let (slots, count) = next_few(&mut slots);
        if count == 0 {
            break;
        }
        for at in places_of(sample_gathered::<P>(simd, cx, leaves, &slots[..count]).into()) {
            waking[slots[at] / BLOCK] |= 1 << (slots[at] % BLOCK);
        }
    }
    wake_slots(cx, leaves, slots_of(waking), changing);
}

/// Samples the wind at leaves from here and there, at most as many as a block has. A bit for each that it may take.
#[inline(always)]
fn sample_gathered<P: Pack>(simd: P::Simd, cx: &Context<'_>, leaves: &LeavesMut<'_>, slots: &[usize]) -> u32 {
    let mut place = [Place::default(); BLOCK];
    let mut drift = [Drift::default(); BLOCK];
    let mut schedule = [Schedule::default(); BLOCK];
    for (at, &slot) in slots.iter().enumerate() {
        place[at] = leaves.place[slot];
        drift[at] = leaves.drift[slot];
        schedule[at] = leaves.schedule[slot];
    }
    LyingBlock { place: &mut place, drift: &drift, schedule: &schedule }.sample_wind::<P>(simd, cx)
}
