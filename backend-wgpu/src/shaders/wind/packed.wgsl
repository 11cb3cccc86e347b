// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/packed.rs
// A velocity in two words: three floats with shorter fractions, x and z of 21 bits, y of 22.
#import prelude

fn round_bits(number: f32, mask: u32) -> u32 {
    let rounded = (bitcast<u32>(number) + ((~mask >> 1u) + 1u)) & mask;
    return select(rounded, 0u, (rounded << 1u) == 0u);
}

fn wind_pack(air: vec3<f32>) -> vec2<u32> {
    let x = round_bits(air.x, PACKED_MASK);
    let y = round_bits(air.y, PACKED_HEIGHT_MASK);
    let z = round_bits(air.z, PACKED_MASK);
    return vec2<u32>(x | (y >> 21u), z | ((y >> 10u) & ~PACKED_MASK));
}

fn wind_unpack(words: vec2<u32>) -> vec3<f32> {
    let y = (words.x << 21u) | ((words.y & ~PACKED_MASK) << 10u);
    return vec3<f32>(bitcast<f32>(words.x & PACKED_MASK), bitcast<f32>(y), bitcast<f32>(words.y & PACKED_MASK));
}
