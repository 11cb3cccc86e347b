// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf of a chunk through one step without an event in it, and lists the others.

use std::sync::atomic::AtomicU32;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::advance::leaf_advance_plain;
use windfall_core::device::leaf::air::leaf_sample_air;
use windfall_core::device::leaf::record::{STATE_FALLING, leaf_state};
use windfall_core::leaf::{LeavesMut, Schedule};

use super::resolve_events::EventList;
use super::sample_air::{sample_air, unit_samples};
use crate::quiet::{UNIT, is_quiet, set_quiet};
use crate::simd::falling_block::FallingBlock;
use crate::simd::prefetch::{FIRST_LEVEL, prefetch};
use crate::simd::{Simd, in_packs};

/// Blocks to prefetch ahead.
const AHEAD: usize = 4;

/// Steps the leaves of one chunk but for those of quiet units, and notes which units are quiet from now on.
pub(crate) fn advance(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[AtomicU32],
    simd: Simd,
) -> EventList {
    let mut events = EventList::default();
    match simd {
        Simd::Scalar => advance_each(cx, leaves, quiet, &mut events),
        Simd::Lanes(level) => in_packs!(level, advance_lanes(cx, leaves, quiet, &mut events)),
    }
    events
}

/// Step until which nothing happens to the leaves of a unit that has just been stepped.
#[inline(always)]
fn quiet_until(is_busy: bool, schedule: &[Schedule]) -> u32 {
    if is_busy { 0 } else { schedule.iter().map(|schedule| schedule.event).min().unwrap_or(0) }
}

/// Steps a chunk one leaf after another.
fn advance_each(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, quiet: &[AtomicU32], events: &mut EventList) {
    for (unit, until) in quiet.iter().enumerate() {
        if is_quiet(until, cx.step.index) {
            continue;
        }
        events.is_stepped[unit] = true;
        let slots = unit * UNIT..leaves.len().min((unit + 1) * UNIT);
        if unit_samples(cx, unit) {
            slots.clone().for_each(|slot| leaf_sample_air(cx, &mut leaves.row_mut(slot)));
        }
        let mut is_busy = false;
        for slot in slots.clone() {
            let is_left = !leaf_advance_plain(cx, &mut leaves.row_mut(slot));
            events.blocks[slot / BLOCK] |= u32::from(is_left) << (slot % BLOCK);
            is_busy |= is_left || leaf_state(leaves.place[slot].bits) == STATE_FALLING;
        }
        set_quiet(until, quiet_until(is_busy, &leaves.schedule[slots]));
    }
}

/// Steps a chunk block by block; the last few leaves, if they are fewer than a block, are all listed.
#[inline(always)]
fn advance_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[AtomicU32],
    events: &mut EventList,
) {
    const BLOCKS: usize = UNIT / BLOCK;
    let count = leaves.len();
    let (place, _) = leaves.place.as_chunks_mut::<BLOCK>();
    let (drift, _) = leaves.drift.as_chunks_mut::<BLOCK>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<BLOCK>();
    let (schedule, _) = leaves.schedule.as_chunks::<BLOCK>();
    let (air, _) = leaves.air.as_chunks_mut::<BLOCK>();
    let units = place.chunks_mut(BLOCKS).zip(drift.chunks_mut(BLOCKS)).zip(attitude.chunks_mut(BLOCKS));
    let units = units.zip(schedule.chunks(BLOCKS)).zip(air.chunks_mut(BLOCKS)).zip(quiet).enumerate();
    for (unit, (((((place, drift), attitude), schedule), air), until)) in units {
        if is_quiet(until, cx.step.index) {
            continue;
        }
        events.is_stepped[unit] = true;
        if unit_samples(cx, unit) {
            sample_air::<P>(simd, cx, place, drift, air);
        }
        let mut is_busy = false;
        let lists = &mut events.blocks[unit * BLOCKS..];
        let blocks = place.iter_mut().zip(drift).zip(attitude).zip(schedule).zip(air.iter()).zip(lists);
        for (((((place, drift), attitude), schedule), air), list) in blocks {
            // Five streams are more than processors foresee.
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(place).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(drift).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(attitude).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(schedule).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(air).wrapping_add(AHEAD), 1);
            let mut block = FallingBlock { place, drift, attitude, schedule, air };
            let outcome = block.advance::<P>(simd, cx);
            *list = outcome.left;
            is_busy |= outcome.is_busy;
        }
        set_quiet(until, quiet_until(is_busy, schedule.as_flattened()));
    }
    let rest = count % BLOCK;
    if rest != 0 {
        events.blocks[count / BLOCK] = (1 << rest) - 1;
        events.is_stepped[count / UNIT] = true;
        set_quiet(&quiet[count / UNIT], 0);
        if unit_samples(cx, count / UNIT) {
            (count - rest..count).for_each(|slot| leaf_sample_air(cx, &mut leaves.row_mut(slot)));
        }
    }
}
