// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves in a shadow map, of the sun or from above.

#import frame/common
#import leaves/shape

// Number of the map.
override MAP: u32 = 0u;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
}

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let point = blade_point(record, in.level, in.vertex);
    var out: Varyings;
    out.clip = frame.shadows[MAP] * vec4(point.world, 1.0);
    out.uv = point.uv;
    out.layer = record.layer_slot & LAYER_MASK;
    return out;
}

@fragment
fn fragment(in: Varyings) {
    // An eighth of a leaf is as fine as the map.
    let level = max(f32(textureNumLevels(images)) - 6.0, 0.0);
    if textureSampleLevel(images, image_sampler, in.uv, in.layer, level).a < 0.5 {
        discard;
    }
}
