// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves as the sun sees them, or who looks from above.

// Which of the maps this draws into.
override MAP: u32 = 0u;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
}

@vertex
fn vertex(
    @builtin(vertex_index) vertex: u32,
    @builtin(instance_index) instance: u32,
    @location(0) first_level: vec2<u32>,
) -> Varyings {
    let record = records[first_level.x + instance];
    let point = blade_point(record, first_level.y, vertex);
    var out: Varyings;
    out.clip = frame.shadows[MAP] * vec4(point.world, 1.0);
    out.uv = point.uv;
    out.layer = record.look.x & LAYER_MASK;
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
