// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/own.rs
#import bindings
#import kernel/math
#import kernel/quaternion
#import kernel/rng
#import motion/lookup

fn turn_to_heading(v: vec3<f32>, heading: u32) -> vec3<f32> {
    let half = sin_cos_half(heading);
    let twice = half.x + half.x;
    let sine = twice * half.y;
    let cosine = 1.0 - twice * half.x;
    return vec3<f32>(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);
}

fn own_scale(course: vec4<u32>) -> f32 {
    return (f32(course.z & HALF_MASK) * SIZE_UNIT) * environment.displacement_gain;
}

fn own_rate(rate: u32) -> u32 {
    let speed = environment.rotation_speed_q16;
    if (speed == WHOLE_STEP) {
        return rate;
    }
    return mul_q16(rate, speed);
}

fn on_grid(v: vec3<f32>) -> vec3<f32> {
    let zero = environment.zero;
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
    let after = on_grid(turn_to_heading(motion_state(table, end).displacement, heading) * scale);
    var way = after - before;
    if (end < start) {
        way = way + own_period(bits, course);
    }
    return way;
}

fn own_velocity(bits: u32, phase: u32, course: vec4<u32>) -> vec3<f32> {
    let local = motion_velocity((bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let rate = own_rate(course.y);
    let rounded = f32(rate >> 16u) * 65536.0 + f32(rate & HALF_MASK);
    let periods_per_s = (rounded * PHASE_UNIT) * environment.inv_dt_s;
    return turn_to_heading(local, course.w >> 16u) * (own_scale(course) * periods_per_s);
}

fn own_orientation(bits: u32, phase: u32, heading: u32) -> vec4<f32> {
    let local = motion_state((bits >> TABLE_SHIFT) & TABLE_MASK, phase).orientation;
    let turn = sin_cos_half(heading >> 16u);
    let spin = sin_cos_half(bits >> SPIN_SHIFT);
    return quat_turn_before(quat_turn_after(local, turn.x, turn.y), spin.x, spin.y);
}
