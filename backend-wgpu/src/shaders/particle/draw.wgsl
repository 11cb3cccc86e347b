// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/draw.rs
// Random numbers of particles.
#import bindings
#import arith/rng

const NORMAL_UNIT: f32 = 2.6429254e-5;

fn particle_words(seed: vec2<u32>, population: u32, id: u32, stream: u32) -> vec4<u32> {
    return philox(seed, vec4<u32>(id, stream, population + 1u, 0u));
}

fn spread_draw(spread: SpreadBlock, a: u32, b: u32) -> f32 {
    let uniform_part = unit_float(a) * 2.0 - 1.0;
    let sum = ((a & 0xffffu) + (a >> 16u)) + ((b & 0xffffu) + (b >> 16u));
    let normal_part = f32(bitcast<i32>(sum) - 131070) * NORMAL_UNIT;
    let share = unit_float(a);
    let even = spread.half_width * uniform_part + spread.deviation * normal_part;
    return spread.mean + (even + spread.cubic_width * ((share * share) * share));
}
