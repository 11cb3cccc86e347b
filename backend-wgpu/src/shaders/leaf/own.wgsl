// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/own.rs
// A leaf's own motion: the tables scaled to its size and speed, turned to its heading, with its spin.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import leaf/cone_spiral
#import leaf/record
#import motion/lookup

struct MotionParams {
    rate: u32,
    size: u32,
    heading: u32,
}

fn motion_params(schedule: Schedule) -> MotionParams {
    return MotionParams(schedule.rate, schedule.size, schedule.heading);
}

fn turn_to_heading(v: vec3<f32>, angle: u32) -> vec3<f32> {
    let half = sin_cos_half(angle);
    let twice = half.x + half.x;
    let sine = twice * half.y;
    let cosine = 1.0 - twice * half.x;
    return vec3<f32>(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);
}

fn own_scale(params: MotionParams) -> f32 {
    return size_ratio(params.size) * scene.displacement_gain;
}

fn own_rate(rate: u32) -> u32 {
    let speed = scene.rotation_speed_q16;
    if (speed == WHOLE_STEP) {
        return rate;
    }
    return mul_q16(rate, speed);
}

// The sum with the anchor is held in an integer, changed by a zero that shader compilers cannot know of: they might take
// the anchor away from where it was just added and leave nothing of the rounding.
fn on_grid(v: vec3<f32>) -> vec3<f32> {
    let zero = scene.zero;
    return vec3<f32>(
        bitcast<f32>(bitcast<u32>(v.x + GRID_ANCHOR) | zero) - GRID_ANCHOR,
        bitcast<f32>(bitcast<u32>(v.y + GRID_ANCHOR) | zero) - GRID_ANCHOR,
        bitcast<f32>(bitcast<u32>(v.z + GRID_ANCHOR) | zero) - GRID_ANCHOR,
    );
}

fn first_phase(bits: u32, word: u32) -> u32 {
    if (winds(bits)) {
        return cone_of(bits).start_age;
    }
    return word;
}

fn table_phase(bits: u32, phase: u32, heading: u32) -> u32 {
    if (scene.cones.count == 0u || !winds(bits)) {
        return phase;
    }
    return cone_table_phase(bits, phase, heading);
}

fn own_period(bits: u32, params: MotionParams) -> vec3<f32> {
    let local = motion_period(motion_table(bits));
    return on_grid(turn_to_heading(local, heading_angle(params.heading)) * own_scale(params));
}

fn own_advance(bits: u32, params: MotionParams, start: u32, end: u32) -> vec3<f32> {
    let table = motion_table(bits);
    let angle = heading_angle(params.heading);
    let scale = own_scale(params);
    let first = table_phase(bits, start, params.heading);
    let last = table_phase(bits, end, params.heading);
    let before = on_grid(turn_to_heading(motion_displacement(table, first), angle) * scale);
    let after = on_grid(turn_to_heading(motion_state(table, last).displacement, angle) * scale);
    var way = after - before;
    if (last < first) {
        way = way + own_period(bits, params);
    }
    if (scene.cones.count == 0u || !winds(bits)) {
        return way;
    }
    let inner = on_grid(cone_offset(bits, start, params.heading) * scale);
    let outer = on_grid(cone_offset(bits, end, params.heading) * scale);
    return (way + (outer - inner)) * select(1.0, 0.0, end < start);
}

fn own_velocity(bits: u32, phase: u32, params: MotionParams) -> vec3<f32> {
    let rate = own_rate(params.rate);
    let rounded = f32(rate >> 16u) * 65536.0 + f32(rate & HALF_MASK);
    if (winds(bits)) {
        let local = cone_velocity(bits, phase, params.heading);
        return local * (own_scale(params) * ((rounded * STEP_UNIT) * scene.inv_dt_s));
    }
    let local = motion_velocity(motion_table(bits), phase);
    let periods_per_s = (rounded * PHASE_UNIT) * scene.inv_dt_s;
    return turn_to_heading(local, heading_angle(params.heading)) * (own_scale(params) * periods_per_s);
}

fn own_orientation(bits: u32, phase: u32, heading: u32) -> vec4<f32> {
    let local = motion_state(motion_table(bits), table_phase(bits, phase, heading)).orientation;
    if (scene.cones.count != 0u && winds(bits)) {
        return cone_orientation(bits, phase, heading, local, spin_angle(bits));
    }
    let turn = sin_cos_half(heading_angle(heading));
    let spin = sin_cos_half(spin_angle(bits));
    return quat_turn_before(quat_turn_after(local, turn.x, turn.y), spin.x, spin.y);
}
