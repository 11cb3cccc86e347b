// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of eight leaves, side by side in SIMD registers.

use bytemuck::{must_cast_mut, must_cast_ref};
use fearless_simd::{Simd, SimdBase, SimdMask, f32x8, mask32x8, u32x8};
use windfall_core::Context;
use windfall_core::arith::eight::{load_records, merge, store_records};
use windfall_core::arith::lane::{LANES, Mask, Real, Word};
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::leaf::fall::{Glide, attitude_after, glide_step, response_of, spin_advance};
use windfall_core::device::leaf::own::MotionParams;
use windfall_core::device::leaf::record::{STATE_FALLING, STATE_RESTING, flies, ground_steps, leaf_state};
use windfall_core::device::terrain::ground::ground_met;
use windfall_core::leaf::{Attitude, Drift, Place, Schedule};

/// Columns of records of three floats and a word: the vector and the word.
#[inline(always)]
pub(crate) fn vector_and_word<S: Simd>([x, y, z, word]: [u32x8<S>; 4]) -> (Vec3<f32x8<S>>, u32x8<S>) {
    (Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z)), word)
}

/// The reverse of [`vector_and_word`].
#[inline(always)]
pub(crate) fn with_word<S: Simd>(v: Vec3<f32x8<S>>, word: u32x8<S>) -> [u32x8<S>; 4] {
    [Real::to_bits(v.x), Real::to_bits(v.y), Real::to_bits(v.z), word]
}

/// A bit for each lane.
#[expect(clippy::cast_possible_truncation, reason = "eight lanes")]
#[inline(always)]
pub(crate) fn bits_of<S: Simd>(mask: mask32x8<S>) -> u8 {
    mask.to_bitmask() as u8
}

/// Result of a step of eight leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// A bit for each leaf that needs a step of its own.
    pub(crate) left: u8,
    /// Something happens to one of them in this step.
    pub(crate) is_busy: bool,
}

/// Steps those of eight leaves that fall without an event and do not land.
#[inline(always)]
pub(crate) fn advance_eight<S: Simd>(
    simd: S,
    cx: &Context<'_>,
    place: &mut [Place; LANES],
    drift: &mut [Drift; LANES],
    attitude: &mut [Attitude; LANES],
    schedule: &[Schedule; LANES],
) -> Outcome {
    let places = load_records(simd, must_cast_ref(place));
    let drifts = load_records(simd, must_cast_ref(drift));
    let (position, bits) = vector_and_word(places);
    let (velocity, phase) = vector_and_word(drifts);
    let [event, rate, size, heading] = load_records(simd, must_cast_ref(schedule));
    let state = leaf_state(bits);
    let waits = u32x8::splat(simd, cx.step.index).less_than(event);
    let is_falling = state.equals(STATE_FALLING);
    let falls = is_falling & waits & !flies(bits);
    let slides = !((Real::to_bits(velocity.x) | Real::to_bits(velocity.z)) << 1).equals(0);
    let is_settling = slides | ground_steps(phase).less_than(bits.all(cx.scene.settle_steps));
    let is_left = !waits | (state.equals(STATE_RESTING) & is_settling);
    if !falls.any() {
        return Outcome { left: bits_of(is_left), is_busy: (is_left | is_falling).any() };
    }
    let start = Glide { position, drift: velocity, phase };
    let response = response_of(cx, bits);
    let glide = glide_step(cx, start, bits, MotionParams { rate, size, heading }, response);
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
    Outcome { left: bits_of(is_left | (falls & lands)), is_busy: true }
}
