// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Colour of the meadow at a place: the ground plane and the blades on it agree.

// Grass albedo (rgb) and dryness (a) at a place on the ground.
fn meadow(at: vec2<f32>, lod: f32) -> vec4<f32> {
    let wide = textureSampleLevel(noise, repeat_sampler, at * 0.011, lod).r;
    let patches = textureSampleLevel(noise, repeat_sampler, at * 0.063 + 0.37, lod).g;
    let dry = clamp(0.28 + 1.3 * (wide - 0.5) + 1.2 * (patches - 0.5), 0.0, 1.0);
    let lush = vec3(0.062, 0.145, 0.022);
    let straw = vec3(0.200, 0.190, 0.058);
    return vec4(mix(lush, straw, dry * 0.75) * (0.85 + 0.5 * (patches - 0.5)), dry);
}
