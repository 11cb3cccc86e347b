// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf of a chunk through one step without an event in it, and lists the others.

use fearless_simd::dispatch;
use windfall_core::Context;
use windfall_core::arith::lane::LANES;
use windfall_core::device::leaf::advance::leaf_advance_plain;
use windfall_core::leaf::LeavesMut;

use super::resolve_events::EventList;
use crate::simd::Simd;
use crate::simd::leaf_eight::advance_eight;

/// Steps the leaves of one chunk.
pub(crate) fn advance(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, simd: Simd) -> EventList {
    let mut events = EventList::default();
    match simd {
        Simd::Scalar => {
            for (slot, mut leaf) in leaves.iter_mut().enumerate() {
                let is_left = !leaf_advance_plain(cx, &mut leaf);
                events.lanes[slot / LANES] |= u8::from(is_left) << (slot % LANES);
            }
        }
        Simd::Lanes(level) => dispatch!(level, simd => advance_lanes(simd, cx, leaves, &mut events)),
    }
    events
}

/// Steps a chunk eight leaves at a time; the last few, if they are fewer than eight, are all listed.
#[inline(always)]
fn advance_lanes<S: fearless_simd::Simd>(
    simd: S,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    events: &mut EventList,
) {
    let count = leaves.len();
    let (place, _) = leaves.place.as_chunks_mut::<LANES>();
    let (drift, _) = leaves.drift.as_chunks_mut::<LANES>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<LANES>();
    let (schedule, _) = leaves.schedule.as_chunks::<LANES>();
    let hot = place.iter_mut().zip(drift).zip(attitude).zip(schedule);
    for (group, (((place, drift), attitude), schedule)) in hot.enumerate() {
        events.lanes[group] = advance_eight(simd, cx, place, drift, attitude, schedule);
    }
    let rest = count % LANES;
    if rest != 0 {
        events.lanes[count / LANES] = (1 << rest) - 1;
    }
}
