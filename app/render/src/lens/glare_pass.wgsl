// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light beyond the threshold, halved in size again and again, blurred at each scale, and put together again. The blur is two
// passes of one dimension, as in James and O'Rorke, "Real-Time Glow", GPU Gems, 2004.

#import lens/fullscreen

@group(0) @binding(1) var<uniform> exposure: Exposure;
@group(1) @binding(0) var source: texture_2d<f32>;
@group(1) @binding(1) var wider: texture_2d<f32>;
@group(1) @binding(2) var smooth_sampler: sampler;
@group(1) @binding(3) var<uniform> scale: GlareScale;

// So that sums stay within half floats.
const BRIGHTEST: f32 = 16384.0;

fn beyond_threshold(at: vec2<u32>) -> vec3<f32> {
    let exposed = textureLoad(source, at, 0).rgb * exposure.multiplier;
    let beyond = max((exposed - lens.glare_threshold) / (1.0 - lens.glare_threshold), vec3(0.0));
    return min(beyond, vec3(BRIGHTEST));
}

// Mean of a square of four, in which what lies outside is dark: light is neither made nor lost.
@fragment
fn bright(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let corner = 2u * vec2<u32>(position.xy);
    var sum = vec3(0.0);
    for (var part = 0u; part < 4u; part++) {
        let at = corner + vec2(part & 1u, part >> 1u);
        if all(at < textureDimensions(source)) {
            sum += beyond_threshold(at);
        }
    }
    return vec4(0.25 * sum, 1.0);
}

@fragment
fn halve(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let corner = 2u * vec2<u32>(position.xy);
    var sum = vec3(0.0);
    for (var part = 0u; part < 4u; part++) {
        let at = corner + vec2(part & 1u, part >> 1u);
        if all(at < textureDimensions(source)) {
            sum += textureLoad(source, at, 0).rgb;
        }
    }
    return vec4(0.25 * sum, 1.0);
}

// Beyond the edge lies what lies at the edge.
fn blurred(at: vec2<i32>, along: vec2<i32>) -> vec3<f32> {
    let last = vec2<i32>(textureDimensions(source)) - 1;
    var sum = scale.kernel[0].x * textureLoad(source, at, 0).rgb;
    for (var offset = 1; offset <= i32(GLARE_RADIUS); offset++) {
        let weight = scale.kernel[offset / 4][offset % 4];
        let ahead = textureLoad(source, min(at + offset * along, last), 0).rgb;
        let behind = textureLoad(source, max(at - offset * along, vec2(0)), 0).rgb;
        sum += weight * (ahead + behind);
    }
    return sum;
}

@fragment
fn blur_across(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(blurred(vec2<i32>(position.xy), vec2(1, 0)), 1.0);
}

// Adds the wider scales, which are half as large.
@fragment
fn blur_along(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let place = 0.5 * position.xy / vec2<f32>(textureDimensions(wider));
    let wide = textureSampleLevel(wider, smooth_sampler, place, 0.0).rgb;
    return vec4(scale.share * blurred(vec2<i32>(position.xy), vec2(0, 1)) + wide, 1.0);
}
