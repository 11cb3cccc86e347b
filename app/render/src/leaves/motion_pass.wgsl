// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Motion of leaves over the picture while the shutter is open. Drawn where leaves were drawn before: the same points, at
// the same depth.

#import frame/common
#import leaf_records
#import leaves/shape
#import lens/motion

@group(3) @binding(1) var<storage, read> places: array<Place>;
@group(3) @binding(2) var<storage, read> attitudes: array<Attitude>;
@group(3) @binding(3) var<storage, read> past_places: array<Place>;
@group(3) @binding(4) var<storage, read> past_attitudes: array<Attitude>;

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) way: vec2<f32>,
}

// A leaf that nothing has turned yet has no attitude.
fn turned(attitude: vec4<f32>) -> vec4<f32> {
    return select(vec4(0.0, 0.0, 0.0, 1.0), attitude, dot(attitude, attitude) > 0.25);
}

// Earlier place of a point of a leaf, which moved and turned without bending.
fn past_of(point: vec3<f32>, slot: u32) -> vec3<f32> {
    let now = places[slot].position;
    let before = past_places[slot];
    if distance(now, before.position) > motion.farthest_m || leaf_state(before.bits) == STATE_DORMANT {
        return point;
    }
    let back = turned(attitudes[slot].quaternion) * vec4(-1.0, -1.0, -1.0, 1.0);
    let turn = quaternion_product(turned(past_attitudes[slot].quaternion), back);
    return before.position + rotate(turn, point - now);
}

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let point = blade_point(record, in.level, in.vertex);
    let past = frame.view_projection * vec4(past_of(point.world, record.layer_slot >> SLOT_SHIFT), 1.0);
    var out: Varyings;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.way = way_between(out.clip, past);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return vec4(in.way, 0.0, 1.0);
}
