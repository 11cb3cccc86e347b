// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Columns of eight leaf records in SIMD registers.

use fearless_simd::{Simd, SimdMask, f32x8, mask32x8, u32x8};
use windfall_core::arith::Vec3;
use windfall_core::arith::lane::Real;

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
