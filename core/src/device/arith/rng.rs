// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/arith/rng.wgsl
//!
//! Counter-based random numbers: every draw is a pure function of (seed, id, stream).
//!
//! # Source
//! Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3" (2011).

use super::lane::Word;

crate::shared_constants! {
    /// First multiplier.
    pub const PHILOX_M0: u32 = 0xD251_1F53;
    /// Second multiplier.
    pub const PHILOX_M1: u32 = 0xCD9E_8D57;
    /// First key increment.
    pub const PHILOX_W0: u32 = 0x9E37_79B9;
    /// Second key increment.
    pub const PHILOX_W1: u32 = 0xBB67_AE85;
    /// Rounds.
    pub const PHILOX_ROUNDS: u32 = 10;
    /// 2^-24: unit of [`unit_float`].
    pub const UNIT_FLOAT: f32 = 1.0 / 16_777_216.0;
}

/// The seed as the two words of the generator's key.
pub(crate) fn seed_words(seed: u64) -> [u32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "low and high word")]
    let words = [seed as u32, (seed >> 32) as u32];
    words
}

/// High word of the 64-bit product. WGSL has none, so the twin works in halves of 16 bits.
#[inline(always)]
pub fn mul_high(a: u32, b: u32) -> u32 {
    a.times_high(b)
}

/// `a b / 65536` without overflow in between, rounded down; the result must fit.
#[inline(always)]
pub fn mul_q16<W: Word>(a: W, b: W) -> W {
    (a.times_high(b) << 16) | (a.times(b) >> 16)
}

/// Four random words for a 128-bit counter under a 64-bit key.
#[inline(always)]
pub fn philox<W: Word>(key: [u32; 2], counter: [W; 4]) -> [W; 4] {
    let mut k = key;
    let mut c = counter;
    for _ in 0..PHILOX_ROUNDS {
        let high0 = c[0].all(PHILOX_M0).times_high(c[0]);
        let high1 = c[2].all(PHILOX_M1).times_high(c[2]);
        let low0 = c[0].all(PHILOX_M0).times(c[0]);
        let low1 = c[2].all(PHILOX_M1).times(c[2]);
        c = [high1 ^ c[1] ^ c[1].all(k[0]), low1, high0 ^ c[3] ^ c[3].all(k[1]), low0];
        k = [k[0].wrapping_add(PHILOX_W0), k[1].wrapping_add(PHILOX_W1)];
    }
    c
}

/// Four random words of entity `id` in `stream`.
#[inline(always)]
pub fn random(seed: [u32; 2], id: u32, stream: u32) -> [u32; 4] {
    philox(seed, [id, stream, 0, 0])
}

/// Uniform integer below `n` from a random word.
#[inline(always)]
pub fn below(word: u32, n: u32) -> u32 {
    mul_high(word, n)
}

/// Triangular integer in -65535..=65535 from a random word.
#[inline(always)]
pub fn triangular(word: u32) -> i32 {
    (word >> 16) as i32 + (word & 0xffff) as i32 - 65535
}

/// Uniform float in [0, 1) with 24 bits from a random word.
#[inline(always)]
pub fn unit_float<W: Word>(word: W) -> W::Real {
    (word >> 8).to_real() * UNIT_FLOAT
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn philox_matches_the_published_vectors() {
        // Known answers of the Random123 distribution for philox4x32-10.
        let cases = [
            ([0; 2], [0; 4], [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]),
            ([u32::MAX; 2], [u32::MAX; 4], [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]),
            (
                [0xa409_3822, 0x299f_31d0],
                [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344],
                [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1],
            ),
        ];
        for (key, counter, expected) in cases {
            assert_eq!(philox(key, counter), expected, "key {key:x?} counter {counter:x?}");
        }
    }

    #[test]
    fn mul_high_is_the_high_word() {
        for (a, b) in
            [(0, 0), (u32::MAX, u32::MAX), (0x1234_5678, 0x9abc_def0), (1 << 31, 3), (0xffff, 0x1_0001)]
        {
            let wide = u64::from(a) * u64::from(b);
            assert_eq!(u64::from(mul_high(a, b)), wide >> 32, "{a} * {b}");
        }
    }
}
