// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves as the sun sees them.

// Which of the shadow maps this draws into.
override CASCADE: u32 = 0u;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
}

@vertex
fn vertex(leaf: Leaf, @location(4) at: vec3<f32>, stem: Stem) -> Varyings {
    let point = blade_point(leaf, at, stem, false);
    var out: Varyings;
    out.clip = frame.shadows[CASCADE] * vec4(point.world, 1.0);
    out.uv = point.uv;
    out.layer = point.layer;
    return out;
}

@fragment
fn fragment(in: Varyings) {
    if textureSampleLevel(images, image_sampler, in.uv, in.layer, 3.0).a < 0.5 {
        discard;
    }
}
