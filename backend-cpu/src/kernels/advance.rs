// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf of a chunk through one step without an event in it, and lists the others.

use std::sync::atomic::AtomicU32;

use fearless_simd::dispatch;
use windfall_core::Context;
use windfall_core::arith::lane::LANES;
use windfall_core::device::leaf::advance::leaf_advance_plain;
use windfall_core::device::leaf::record::{STATE_FALLING, leaf_state};
use windfall_core::leaf::{LeavesMut, Schedule};

use super::resolve_events::EventList;
use crate::quiet::{UNIT, is_quiet, set_quiet};
use crate::simd::Simd;
use crate::simd::leaf_eight::{Outcome, advance_eight};
use crate::simd::prefetch::{FIRST_LEVEL, prefetch};

/// Groups of eight leaves to prefetch ahead.
const AHEAD: usize = 8;

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
        Simd::Lanes(level) => dispatch!(level, simd => advance_lanes(simd, cx, leaves, quiet, &mut events)),
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
        let mut is_busy = false;
        for slot in slots.clone() {
            let is_left = !leaf_advance_plain(cx, &mut leaves.row_mut(slot));
            events.lanes[slot / LANES] |= u8::from(is_left) << (slot % LANES);
            is_busy |= is_left || leaf_state(leaves.place[slot].bits) == STATE_FALLING;
        }
        set_quiet(until, quiet_until(is_busy, &leaves.schedule[slots]));
    }
}

/// Steps a chunk eight leaves at a time; the last few, if they are fewer than eight, are all listed.
#[inline(always)]
fn advance_lanes<S: fearless_simd::Simd>(
    simd: S,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[AtomicU32],
    events: &mut EventList,
) {
    const GROUPS: usize = UNIT / LANES;
    let count = leaves.len();
    let (place, _) = leaves.place.as_chunks_mut::<LANES>();
    let (drift, _) = leaves.drift.as_chunks_mut::<LANES>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<LANES>();
    let (schedule, _) = leaves.schedule.as_chunks::<LANES>();
    let units = place.chunks_mut(GROUPS).zip(drift.chunks_mut(GROUPS)).zip(attitude.chunks_mut(GROUPS));
    let units = units.zip(schedule.chunks(GROUPS)).zip(quiet).enumerate();
    for (unit, ((((place, drift), attitude), schedule), until)) in units {
        if is_quiet(until, cx.step.index) {
            continue;
        }
        events.is_stepped[unit] = true;
        let mut is_busy = false;
        let lanes = &mut events.lanes[unit * GROUPS..];
        let groups = place.iter_mut().zip(drift).zip(attitude).zip(schedule).zip(lanes);
        for ((((place, drift), attitude), schedule), left) in groups {
            // Four streams are more than processors foresee.
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(place).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(drift).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(attitude).wrapping_add(AHEAD), 1);
            prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(schedule).wrapping_add(AHEAD), 1);
            let outcome: Outcome = advance_eight(simd, cx, place, drift, attitude, schedule);
            *left = outcome.left;
            is_busy |= outcome.is_busy;
        }
        set_quiet(until, quiet_until(is_busy, schedule.as_flattened()));
    }
    let rest = count % LANES;
    if rest != 0 {
        events.lanes[count / LANES] = (1 << rest) - 1;
        events.is_stepped[count / UNIT] = true;
        set_quiet(&quiet[count / UNIT], 0);
    }
}
