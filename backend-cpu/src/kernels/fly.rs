// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/fly.wgsl
//!
//! Moves the leaves of a chunk that fly as bodies through one step.

use std::ops::Range;

use bytemuck::{must_cast_mut, must_cast_ref};
use fearless_simd::{Simd as Lanes, dispatch, f32x8, mask32x8, u32x8};
use windfall_core::Context;
use windfall_core::arith::Quat;
use windfall_core::arith::eight::{load_records, merge, store_records};
use windfall_core::arith::lane::{LANES, Mask, Real, Word};
use windfall_core::device::leaf::fly::{Flight, flight_advance, leaf_fly, update_regime};
use windfall_core::device::leaf::record::{body_spin, body_spin_words, flies, regime_state};
use windfall_core::device::terrain::ground::ground_met;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::LeavesMut;

use super::resolve_events::EventList;
use crate::quiet::UNIT;
use crate::simd::Simd;
use crate::simd::leaf_eight::{bits_of, vector_and_word, with_word};

/// Steps the bodies of one chunk, in the units that `advance` has not passed by.
pub(crate) fn fly(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList, simd: Simd) {
    match simd {
        Simd::Scalar => {
            let count = leaves.len();
            for slot in events.stepped().flat_map(|unit| slots_of(unit, count)) {
                leaf_fly(cx, &mut leaves.row_mut(slot));
            }
        }
        Simd::Lanes(level) => dispatch!(level, simd => fly_lanes(simd, cx, leaves, events)),
    }
}

/// Slots of a unit in a chunk of so many.
fn slots_of(unit: usize, count: usize) -> Range<usize> {
    unit * UNIT..count.min((unit + 1) * UNIT)
}

/// Steps the bodies of units eight slots at a time; those that land, and the last few slots, one by one.
#[inline(always)]
fn fly_lanes<S: Lanes>(simd: S, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList) {
    for unit in events.stepped() {
        let slots = slots_of(unit, leaves.len());
        let few = slots.end - slots.len() % LANES;
        for first in (slots.start..few).step_by(LANES) {
            let mut landing = fly_eight(simd, cx, leaves, first);
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

/// Eight records of a column from a slot on.
#[inline(always)]
fn eight_of<T>(column: &mut [T], first: usize) -> &mut [T; LANES] {
    column[first..].first_chunk_mut().expect("eight slots are left")
}

/// Words of leaves that fly. What others count in their place would be subnormal floats, on which processors are slow.
#[inline(always)]
fn flying<S: Lanes>(on: mask32x8<S>, words: u32x8<S>) -> u32x8<S> {
    Mask::select(on, words, Word::all(words, 0))
}

/// Steps those of eight leaves from a slot on that fly as bodies and do not land. A bit for each that does.
#[inline(always)]
fn fly_eight<S: Lanes>(simd: S, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, first: usize) -> u8 {
    let place = eight_of(leaves.place, first);
    let places = load_records(simd, must_cast_ref(place));
    let (position, bits) = vector_and_word(places);
    let on = flies(bits);
    if !on.any() {
        return 0;
    }
    let (drift, attitude) = (eight_of(leaves.drift, first), eight_of(leaves.attitude, first));
    let schedule = eight_of(leaves.schedule, first);
    let drifts = load_records(simd, must_cast_ref(drift));
    let attitudes = load_records(simd, must_cast_ref(attitude));
    let schedules = load_records(simd, must_cast_ref(schedule));
    let (velocity, phase) = vector_and_word(drifts);
    let [event, rate, size, heading] = schedules;
    let start = Flight {
        position,
        velocity,
        pose: Quat::from(attitudes.map(<f32x8<S> as Real>::from_bits)),
        spin: body_spin(flying(on, phase), flying(on, rate), flying(on, heading)),
    };
    let wind = wind_at(cx, start.position);
    let flight = flight_advance(cx, start, bits, size, wind);
    let identity = eight_of(leaves.identity, first);
    let identities = load_records(simd, must_cast_ref(identity));
    let [id, release, fall_time, appearance] = identities;
    let regime = update_regime(cx, &flight, wind, regime_state(fall_time), bits);
    let lands = ground_met(cx, flight.position);
    let moved = on & !lands;
    let [x, y, z] = body_spin_words(flight.spin);
    let new_places = merge(moved, with_word(flight.position, regime.bits), places);
    let new_drifts = merge(moved, with_word(flight.velocity, x), drifts);
    let new_attitudes = merge(moved, flight.pose.to_array().map(Real::to_bits), attitudes);
    let new_schedules = merge(moved, [event, y, size, z], schedules);
    let new_identities = merge(moved, [id, release, regime.state, appearance], identities);
    store_records(must_cast_mut(place), new_places);
    store_records(must_cast_mut(drift), new_drifts);
    store_records(must_cast_mut(attitude), new_attitudes);
    store_records(must_cast_mut(schedule), new_schedules);
    store_records(must_cast_mut(identity), new_identities);
    bits_of(on & lands)
}
