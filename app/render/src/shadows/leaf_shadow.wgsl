// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves in a shadow map, of the sun or from above.

#import frame/common
#import leaves/front
#import leaves/shape

// Number of the map.
override MAP: u32 = 0u;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
    // Arrival of its front before which nothing is left.
    @location(2) @interpolate(flat) burnt: f32,
}

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let point = blade_point(record, in.level, in.vertex);
    var out: Varyings;
    out.clip = frame.shadows[MAP] * vec4(point.world, 1.0);
    out.uv = point.uv;
    out.layer = record.layer_slot & LAYER_MASK;
    out.burnt = select(-1.0, crumbled_before(front_of(record), 0.5), LEAVES_BURN);
    return out;
}

@fragment
fn fragment(in: Varyings) {
    // An eighth of a leaf is as fine as the map.
    let level = max(f32(textureNumLevels(images)) - 6.0, 0.0);
    if textureSampleLevel(images, image_sampler, in.uv, in.layer, level).a < 0.5 {
        discard;
    }
    if LEAVES_BURN && textureSampleLevel(surfaces, image_sampler, in.uv, in.layer, level).a < in.burnt {
        discard;
    }
}
