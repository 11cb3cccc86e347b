// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Motion of solid parts over the picture while the shutter is open. Drawn where they were drawn before: the same points, at
// the same depth.

#import frame/common
#import objects/object_shape
#import lens/motion

@group(2) @binding(1) var<storage, read> past_poses: array<PastPose>;

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) way: vec2<f32>,
}

@vertex
fn vertex(solid: SolidVertex, @builtin(instance_index) part: u32) -> Varyings {
    let point = object_point(solid, part);
    let object = objects[part];
    // Points of a joint go with the part that they belong to.
    let pose = past_poses[part];
    let local = into_part(object.turn, point.standing - object.center_m);
    let past = frame.view_projection * vec4(set_down(pose.center_m + rotate(pose.turn, local)), 1.0);
    var out: Varyings;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.way = way_between(out.clip, past);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return vec4(in.way, 0.0, 1.0);
}
