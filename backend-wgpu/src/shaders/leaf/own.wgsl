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

fn on_grid(v: vec3<f32>) -> vec3<f32> {
    let zero = environment.motion.y;
    return vec3<f32>(
        bitcast<f32>(bitcast<u32>(v.x + GRID_ANCHOR) | zero) - GRID_ANCHOR,
        bitcast<f32>(bitcast<u32>(v.y + GRID_ANCHOR) | zero) - GRID_ANCHOR,
        bitcast<f32>(bitcast<u32>(v.z + GRID_ANCHOR) | zero) - GRID_ANCHOR,
    );
}

fn own_period(bits: u32, course: vec4<u32>) -> vec3<f32> {
    let local = motion_period((bits >> TABLE_SHIFT) & TABLE_MASK);
    return on_grid(turn_to_heading(local, course.w >> 16u) * own_scale(course));
}

fn own_advance(bits: u32, course: vec4<u32>, start: u32, end: u32) -> vec3<f32> {
    let table = (bits >> TABLE_SHIFT) & TABLE_MASK;
    let heading = course.w >> 16u;
    let scale = own_scale(course);
    let before = on_grid(turn_to_heading(motion_displacement(table, start), heading) * scale);
    let after = on_grid(turn_to_heading(motion_displacement(table, end), heading) * scale);
    let wrapped = select(0.0, 1.0, end < start);
    return (after - before) + own_period(bits, course) * wrapped;
}

fn own_velocity(bits: u32, phase: u32, course: vec4<u32>) -> vec3<f32> {
    let local = motion_velocity((bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let rate = own_rate(course.y);
    let rounded = f32(rate >> 16u) * 65536.0 + f32(rate & HALF_MASK);
    let per_second = rounded * environment.time.z;
    return turn_to_heading(local, course.w >> 16u) * (own_scale(course) * per_second);
}

fn own_orientation(bits: u32, phase: u32, heading: u32) -> vec4<f32> {
    let local = motion_orientation((bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let heading_turn = sin_cos_turns((heading >> 16u) << 15u);
    let spin_turn = sin_cos_turns((bits >> SPIN_SHIFT) << 15u);
    let turned = quat_multiply(vec4<f32>(0.0, heading_turn.x, 0.0, heading_turn.y), local);
    return quat_multiply(turned, vec4<f32>(0.0, spin_turn.x, 0.0, spin_turn.y));
}
