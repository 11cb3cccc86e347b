// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/draw.wgsl
//!
//! Random numbers of particles: pure functions of the seed, the population and the particle's number within it.

use crate::arith::rng::{philox, unit_float};
use crate::blocks::SpreadBlock;

/// Inverse of the standard deviation of the sum of four 16-bit numbers.
const NORMAL_UNIT: f32 = 2.642_925_4e-5;

/// Four random words of a particle; each kind of draw has a stream of its own.
#[inline(always)]
pub fn particle_words(seed: [u32; 2], population: u32, id: u32, stream: u32) -> [u32; 4] {
    // Leaves leave the third word of the counter zero.
    philox(seed, [id, stream, population + 1, 0])
}

/// Number of a spread from two random words.
#[inline(always)]
pub fn spread_draw(spread: SpreadBlock, a: u32, b: u32) -> f32 {
    let uniform = unit_float(a) * 2.0 - 1.0;
    let sum = ((a & 0xffff) + (a >> 16)) + ((b & 0xffff) + (b >> 16));
    let normal = (sum as i32 - 131_070) as f32 * NORMAL_UNIT;
    let share = unit_float(a);
    let even = spread.half_width * uniform + spread.deviation * normal;
    spread.mean + (even + spread.cubic_width * ((share * share) * share))
}
