// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light to picture: exposure, a filmic curve, gamma, and a grain of dither against bands in the sky.

@group(1) @binding(0) var light: texture_2d<f32>;

// Off where the target encodes by itself.
override ENCODE_GAMMA: bool = true;

// Filmic curve fitted to the ACES reference by Narkowicz (2015).
fn filmic(x: vec3<f32>) -> vec3<f32> {
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(0.0), vec3(1.0));
}

fn srgb_encode(linear: vec3<f32>) -> vec3<f32> {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3(0.0031308));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) output_at: vec4<f32>) -> @location(0) vec4<f32> {
    let at = output_at.xy - vec2(frame.right.w, frame.up.w);
    var color = textureLoad(light, vec2<i32>(at), 0).rgb * frame.air.y;
    let middle = (at * frame.viewport.zw - 0.5) * vec2(1.0, 0.8);
    color *= 1.0 - 0.35 * dot(middle, middle);
    color = max(mix(vec3(luminance(color)), color, 1.12), vec3(0.0));
    var encoded = filmic(color);
    if ENCODE_GAMMA {
        encoded = srgb_encode(encoded);
    }
    let grain = fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
    return vec4(encoded + (grain - 0.5) / 255.0, 1.0);
}
