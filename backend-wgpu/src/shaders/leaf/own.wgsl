// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/own.rs
#import bindings
#import kernel/math
#import kernel/quaternion
#import kernel/rng
#import motion/lookup

fn turn_to_heading(v: vec3<f32>, heading: u32) -> vec3<f32> {
    let turn = sin_cos_turns(heading << 16u);
    let sine = turn.x;
    let cosine = turn.y;
    return vec3<f32>(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);
}

fn own_scale(course: vec4<u32>) -> f32 {
    return (f32(course.z & HALF_MASK) * SIZE_UNIT) * environment.time.w;
}

fn own_rate(rate: u32) -> u32 {
    return mul_q16(rate, environment.counts.w);
}

fn own_velocity(bits: u32, phase: u32, course: vec4<u32>) -> vec3<f32> {
    let local = motion_velocity((bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let per_second = f32(own_rate(course.y) >> 8u) * environment.time.z;
    return turn_to_heading(local, course.w >> 16u) * (own_scale(course) * per_second);
}

fn own_orientation(bits: u32, phase: u32, heading: u32) -> vec4<f32> {
    let local = motion_orientation((bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let heading_turn = sin_cos_turns((heading >> 16u) << 15u);
    let spin_turn = sin_cos_turns((bits >> SPIN_SHIFT) << 15u);
    let turned = quat_multiply(vec4<f32>(0.0, heading_turn.x, 0.0, heading_turn.y), local);
    return quat_multiply(turned, vec4<f32>(0.0, spin_turn.x, 0.0, spin_turn.y));
}
