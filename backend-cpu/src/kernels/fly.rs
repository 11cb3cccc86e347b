// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/fly.wgsl
//!
//! Moves the leaves of a chunk that fly as bodies through one step, and leaves those that land to `attend`.

use bytemuck::{must_cast_mut, must_cast_ref};
use fearless_simd::{Simd as Lanes, SimdBase, dispatch, f32x8, u32x8};
use windfall_core::Context;
use windfall_core::kernel::Quat;
use windfall_core::kernel::eight::{load_records, merge, store_records};
use windfall_core::kernel::lane::{LANES, Mask, Real, Word};
use windfall_core::leaf::fly::{Flight, flies, flight_advance, leaf_fly_plain};
use windfall_core::leaf::{Attitude, Course, Drift, LeavesMut, Place};
use windfall_core::wind::sample::wind_at;

use super::attend::Attend;
use super::eight::{bits_of, vector, with_word};
use crate::simd::Simd;

/// Steps the bodies of one chunk.
pub(crate) fn fly(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, simd: Simd, due: &mut Attend) {
    match simd {
        Simd::Scalar => {
            for (slot, mut leaf) in leaves.iter_mut().enumerate() {
                let attend = !leaf_fly_plain(cx, &mut leaf);
                due.lanes[slot / LANES] |= u8::from(attend) << (slot % LANES);
            }
        }
        Simd::Lanes(level) => dispatch!(level, simd => fly_lanes(simd, cx, leaves, due)),
    }
}

/// Steps the bodies of a chunk eight slots at a time; `advance` has left the last few, if they are fewer, to `attend`.
#[inline(always)]
fn fly_lanes<S: Lanes>(simd: S, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, due: &mut Attend) {
    let (place, _) = leaves.place.as_chunks_mut::<LANES>();
    let (drift, _) = leaves.drift.as_chunks_mut::<LANES>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<LANES>();
    let (course, _) = leaves.course.as_chunks_mut::<LANES>();
    let records = place.iter_mut().zip(drift).zip(attitude).zip(course);
    for (group, (((place, drift), attitude), course)) in records.enumerate() {
        due.lanes[group] |= fly_eight(simd, cx, place, drift, attitude, course);
    }
}

/// Steps those of eight leaves that fly as bodies and do not land. A bit for each that does.
#[inline(always)]
fn fly_eight<S: Lanes>(
    simd: S,
    cx: &Context<'_>,
    place: &mut [Place; LANES],
    drift: &mut [Drift; LANES],
    attitude: &mut [Attitude; LANES],
    course: &mut [Course; LANES],
) -> u8 {
    let places = load_records(simd, must_cast_ref(place));
    let courses = load_records(simd, must_cast_ref(course));
    let [event, rate, size, heading] = courses;
    let bits = places[3];
    let waits = u32x8::splat(simd, cx.step.index.0[0]).less_than(event);
    let on = flies(bits) & waits;
    if !on.any() {
        return 0;
    }
    let drifts = load_records(simd, must_cast_ref(drift));
    let attitudes = load_records(simd, must_cast_ref(attitude));
    let start = Flight {
        position: vector(places),
        velocity: vector(drifts),
        pose: Quat::from(attitudes.map(<f32x8<S> as Real>::from_bits)),
        spin: vector([drifts[3], rate, heading, heading]),
    };
    let wind = wind_at(cx, start.position);
    let flight = flight_advance(cx, start, bits, size, wind);
    let lands = flight.position.y.less_than(f32x8::splat(simd, cx.environment.ground.0[1]));
    let moved = on & !lands;
    let [x, y, z] = [flight.spin.x, flight.spin.y, flight.spin.z].map(Real::to_bits);
    let new_places = merge(moved, with_word(flight.position, bits), places);
    let new_drifts = merge(moved, with_word(flight.velocity, x), drifts);
    let new_attitudes = merge(moved, flight.pose.to_array().map(Real::to_bits), attitudes);
    let new_courses = merge(moved, [event, y, size, z], courses);
    store_records(must_cast_mut(place), new_places);
    store_records(must_cast_mut(drift), new_drifts);
    store_records(must_cast_mut(attitude), new_attitudes);
    store_records(must_cast_mut(course), new_courses);
    bits_of(on & lands)
}
