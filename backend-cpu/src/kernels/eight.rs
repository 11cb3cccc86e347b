// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of eight leaves, side by side in SIMD registers.

use bytemuck::{must_cast_mut, must_cast_ref};
use fearless_simd::{Simd, SimdBase, SimdMask, f32x8, mask32x8, u32x8};
use windfall_core::Context;
use windfall_core::kernel::eight::{load_records, merge, store_records};
use windfall_core::kernel::lane::{LANES, Mask, Real, Word};
use windfall_core::kernel::{Quat, Vec3};
use windfall_core::leaf::fall::{Glide, attitude_after, glide_step, response_of, spin_advance};
use windfall_core::leaf::fly::flies;
use windfall_core::leaf::own::Manner;
use windfall_core::leaf::record::{STATE_FALLING, STATE_MASK, STATE_RESTING};
use windfall_core::leaf::{Attitude, Course, Drift, Place};
use windfall_core::terrain::ground::ground_met;

/// Three columns of float bits as a vector.
#[inline(always)]
pub(super) fn vector<S: Simd>(words: [u32x8<S>; 4]) -> Vec3<f32x8<S>> {
    Vec3::new(Real::from_bits(words[0]), Real::from_bits(words[1]), Real::from_bits(words[2]))
}

/// A vector and a word as four columns.
#[inline(always)]
pub(super) fn with_word<S: Simd>(v: Vec3<f32x8<S>>, word: u32x8<S>) -> [u32x8<S>; 4] {
    [Real::to_bits(v.x), Real::to_bits(v.y), Real::to_bits(v.z), word]
}

/// A bit for each lane.
#[expect(clippy::cast_possible_truncation, reason = "eight lanes")]
#[inline(always)]
pub(super) fn bits_of<S: Simd>(mask: mask32x8<S>) -> u8 {
    mask.to_bitmask() as u8
}

/// Steps those of eight leaves that fall without an event and do not land. A bit for each of the others that have to
/// be attended to.
#[inline(always)]
pub(super) fn advance_eight<S: Simd>(
    simd: S,
    cx: &Context<'_>,
    place: &mut [Place; LANES],
    drift: &mut [Drift; LANES],
    attitude: &mut [Attitude; LANES],
    course: &[Course; LANES],
) -> u8 {
    let places = load_records(simd, must_cast_ref(place));
    let drifts = load_records(simd, must_cast_ref(drift));
    let [event, rate, size, heading] = load_records(simd, must_cast_ref(course));
    let bits = places[3];
    let state = bits & STATE_MASK;
    let waits = u32x8::splat(simd, cx.step.index).less_than(event);
    let falls = state.equals(STATE_FALLING) & waits & !flies(bits);
    let slides = !((drifts[0] | drifts[2]) << 1).equals(0);
    let stirs = slides | drifts[3].less_than(bits.all(cx.environment.settle_steps));
    let due = !waits | (state.equals(STATE_RESTING) & stirs);
    if !falls.any() {
        return bits_of(due);
    }
    let start = Glide { position: vector(places), drift: vector(drifts), phase: drifts[3] };
    let response = response_of(cx, bits);
    let glide = glide_step(cx, start, bits, Manner { rate, size, heading }, response);
    let spun = spin_advance(bits, heading, response.fastest_spin);
    let before =
        || Quat::from(load_records(simd, must_cast_ref(attitude)).map(<f32x8<S> as Real>::from_bits));
    let (bits, turned) = attitude_after(cx, spun, glide.phase, heading, before);

    let lands = ground_met(cx, glide.position);
    let moved = falls & !lands;
    let mut new_places = with_word(glide.position, bits);
    let mut new_drifts = with_word(glide.drift, glide.phase);
    let mut new_attitudes = turned.to_array().map(Real::to_bits);
    if moved.any_false() {
        new_places = merge(moved, new_places, places);
        new_drifts = merge(moved, new_drifts, drifts);
        new_attitudes = merge(moved, new_attitudes, load_records(simd, must_cast_ref(attitude)));
    }
    store_records(must_cast_mut(place), new_places);
    store_records(must_cast_mut(drift), new_drifts);
    store_records(must_cast_mut(attitude), new_attitudes);
    bits_of(due | (falls & lands))
}
