// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/arith/rng.rs
// Counter-based random numbers (Philox 4x32-10) and fixed-point products.
#import prelude

fn mul_high(a: u32, b: u32) -> u32 {
    let a_low = a & 0xffffu;
    let a_high = a >> 16u;
    let b_low = b & 0xffffu;
    let b_high = b >> 16u;
    let middle = a_high * b_low + ((a_low * b_low) >> 16u);
    let carry = (middle & 0xffffu) + a_low * b_high;
    return a_high * b_high + (middle >> 16u) + (carry >> 16u);
}

fn mul_q16(a: u32, b: u32) -> u32 {
    return (mul_high(a, b) << 16u) | ((a * b) >> 16u);
}

fn philox(key: vec2<u32>, counter: vec4<u32>) -> vec4<u32> {
    var k = key;
    var c = counter;
    for (var turn = 0u; turn < PHILOX_ROUNDS; turn++) {
        let high0 = mul_high(PHILOX_M0, c.x);
        let high1 = mul_high(PHILOX_M1, c.z);
        let low0 = PHILOX_M0 * c.x;
        let low1 = PHILOX_M1 * c.z;
        c = vec4<u32>(high1 ^ c.y ^ k.x, low1, high0 ^ c.w ^ k.y, low0);
        k = vec2<u32>(k.x + PHILOX_W0, k.y + PHILOX_W1);
    }
    return c;
}

fn random(seed: vec2<u32>, id: u32, stream: u32) -> vec4<u32> {
    return philox(seed, vec4<u32>(id, stream, 0u, 0u));
}

fn below(word: u32, n: u32) -> u32 {
    return mul_high(word, n);
}

fn triangular(word: u32) -> i32 {
    return bitcast<i32>(word >> 16u) + bitcast<i32>(word & 0xffffu) - 65535;
}

fn unit_float(word: u32) -> f32 {
    return f32(word >> 8u) * UNIT_FLOAT;
}
