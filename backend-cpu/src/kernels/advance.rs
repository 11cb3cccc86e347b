// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf of a chunk through one step without an event in it, and lists the others.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::advance::leaf_advance_plain;
use windfall_core::device::leaf::air::leaf_sample_air;
use windfall_core::device::leaf::record::{STATE_FALLING, leaf_state};
use windfall_core::leaf::LeavesMut;

use super::resolve_events::{EventList, bits_of_block};
use super::sample_air::{sample_air, unit_samples};
use crate::quiet::{QuietUnit, UNIT, places_of};
use crate::simd::falling_block::FallingBlock;
use crate::simd::prefetch::{FIRST_LEVEL, prefetch};
use crate::simd::{Simd, in_packs};

/// Blocks of a unit: as many are prefetched ahead.
const BLOCKS: usize = UNIT / BLOCK;

/// Steps the leaves of one chunk but for those that are quiet, and notes which are quiet from now on.
pub(crate) fn advance(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[QuietUnit],
    simd: Simd,
) -> EventList {
    let mut events = EventList::default();
    match simd {
        Simd::Scalar => advance_each(cx, leaves, quiet, &mut events),
        Simd::Lanes(level) => in_packs!(level, advance_lanes(cx, leaves, quiet, &mut events)),
    }
    events
}

/// Steps a chunk one leaf after another.
fn advance_each(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, quiet: &[QuietUnit], events: &mut EventList) {
    for (unit, of_unit) in quiet.iter().enumerate() {
        let due = of_unit.stirring(cx.step.index);
        if due == 0 {
            continue;
        }
        let count = leaves.len();
        let slots = || places_of(due).map(|place| unit * UNIT + place).take_while(|&slot| slot < count);
        if unit_samples(cx, unit) {
            slots().for_each(|slot| leaf_sample_air(cx, &mut leaves.row_mut(slot)));
        }
        let mut stirring = 0;
        let mut until = if due == u64::MAX { u32::MAX } else { of_unit.until() };
        for slot in slots() {
            let is_left = !leaf_advance_plain(cx, &mut leaves.row_mut(slot));
            events.blocks[slot / BLOCK] |= u32::from(is_left) << (slot % BLOCK);
            if is_left || leaf_state(leaves.place[slot].bits) == STATE_FALLING {
                stirring |= 1 << (slot % UNIT);
            } else {
                until = until.min(leaves.schedule[slot].event);
            }
        }
        events.stirring[unit] = stirring;
        of_unit.set(stirring, until);
    }
}

/// Steps a chunk block by block; the last few leaves, if they are fewer than a block, are all listed.
#[inline(always)]
fn advance_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[QuietUnit],
    events: &mut EventList,
) {
    const WHOLE: u32 = (1 << BLOCK) - 1;
    let count = leaves.len();
    let (place, _) = leaves.place.as_chunks_mut::<BLOCK>();
    let (drift, _) = leaves.drift.as_chunks_mut::<BLOCK>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<BLOCK>();
    let (schedule, _) = leaves.schedule.as_chunks::<BLOCK>();
    let (air, _) = leaves.air.as_chunks_mut::<BLOCK>();
    let units = place.chunks_mut(BLOCKS).zip(drift.chunks_mut(BLOCKS)).zip(attitude.chunks_mut(BLOCKS));
    let units = units.zip(schedule.chunks(BLOCKS)).zip(air.chunks_mut(BLOCKS)).zip(quiet).enumerate();
    for (unit, (((((place, drift), attitude), schedule), air), of_unit)) in units {
        let due = of_unit.stirring(cx.step.index);
        let due_ahead = quiet.get(unit + 1).map_or(0, |unit| unit.stirring(cx.step.index));
        if due | due_ahead == 0 {
            continue;
        }
        let samples = unit_samples(cx, unit);
        let mut stirring = 0;
        let mut until = if due == u64::MAX { u32::MAX } else { of_unit.until() };
        let lists = &mut events.blocks[unit * BLOCKS..];
        let blocks = place.iter_mut().zip(drift).zip(attitude).zip(schedule).zip(air).zip(lists).enumerate();
        for (number, (((((place, drift), attitude), schedule), air), list)) in blocks {
            if bits_of_block(due_ahead, number) != 0 {
                // Five streams are more than processors foresee.
                prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(place).wrapping_add(BLOCKS), 1);
                prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(drift).wrapping_add(BLOCKS), 1);
                prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(attitude).wrapping_add(BLOCKS), 1);
                prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(schedule).wrapping_add(BLOCKS), 1);
                prefetch::<FIRST_LEVEL, _>(std::ptr::from_ref(air).wrapping_add(BLOCKS), 1);
            }
            let before = bits_of_block(due, number);
            if before == 0 {
                continue;
            }
            if samples {
                sample_air::<P>(simd, cx, place, drift, air);
            }
            let mut block = FallingBlock { place, drift, attitude, schedule, air };
            let outcome = block.advance::<P>(simd, cx);
            *list = outcome.left;
            stirring |= u64::from(outcome.stirring) << (number * BLOCK);
            // Events change while a leaf stirs: what counts is that of one that no longer does.
            let examined = if due == u64::MAX { WHOLE } else { before };
            if examined & !outcome.stirring != 0 {
                until = schedule.iter().fold(until, |until, schedule| until.min(schedule.event));
            }
        }
        if due != 0 {
            events.stirring[unit] = stirring;
            of_unit.set(stirring, until);
        }
    }
    let rest = count % BLOCK;
    if rest != 0 {
        events.blocks[count / BLOCK] = (1 << rest) - 1;
        events.stirring[count / UNIT] |= u64::from(events.blocks[count / BLOCK]) << (count % UNIT - rest);
        quiet[count / UNIT].set(0, 0);
        if unit_samples(cx, count / UNIT) {
            (count - rest..count).for_each(|slot| leaf_sample_air(cx, &mut leaves.row_mut(slot)));
        }
    }
}
