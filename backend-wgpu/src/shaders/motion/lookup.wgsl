// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/motion/lookup.rs
// Displacement, orientation and velocity of the motion tables at a phase.
#import bindings
#import arith/quaternion

struct MotionState {
    displacement: vec3<f32>,
    orientation: vec4<f32>,
}

fn fraction_of(phase: u32) -> f32 {
    return f32(phase & PHASE_FRACTION_MASK) * PHASE_FRACTION_UNIT;
}

fn row_of(table: u32, phase: u32) -> u32 {
    return table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT);
}

fn displacement_in(row: u32) -> vec3<f32> {
    let state = bitcast<vec4<f32>>(tables[scene.first_motion_row + 2u * row]);
    return vec3<f32>(state.x, state.y, state.z);
}

fn motion_displacement(table: u32, phase: u32) -> vec3<f32> {
    let row = row_of(table, phase);
    return vec3_lerp(displacement_in(row), displacement_in(row + 1u), fraction_of(phase));
}

fn motion_period(table: u32) -> vec3<f32> {
    return displacement_in(row_of(table, 0u) + (TABLE_ROWS - 1u));
}

fn motion_state(table: u32, phase: u32) -> MotionState {
    let row = row_of(table, phase);
    let t = fraction_of(phase);
    let displacement = vec3_lerp(displacement_in(row), displacement_in(row + 1u), t);
    let a = bitcast<vec4<f32>>(tables[scene.first_motion_row + 2u * row + 1u]);
    let b = bitcast<vec4<f32>>(tables[scene.first_motion_row + 2u * row + 3u]);
    let orientation =
        vec4<f32>(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.w + t * (b.w - a.w));
    return MotionState(displacement, quat_renormalize(orientation));
}

fn motion_velocity(table: u32, phase: u32) -> vec3<f32> {
    let first = scene.first_motion_row + scene.species_count * (2u * TABLES_PER_SPECIES * TABLE_ROWS);
    let row = first + row_of(table, phase);
    let a = bitcast<vec4<f32>>(tables[row]);
    let b = bitcast<vec4<f32>>(tables[row + 1u]);
    return vec3_lerp(vec3<f32>(a.x, a.y, a.z), vec3<f32>(b.x, b.y, b.z), fraction_of(phase));
}
