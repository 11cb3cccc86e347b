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

fn weights_of(phase: u32) -> u32 {
    let after = (phase >> PAIR_WEIGHT_SHIFT) & (PAIR_WEIGHT - 1u);
    return (PAIR_WEIGHT - after) | (after << 16u);
}

fn dot_halves(pair: u32, weights: u32) -> f32 {
    let low = (bitcast<i32>(pair << 16u) >> 16u) * (bitcast<i32>(weights << 16u) >> 16u);
    let high = (bitcast<i32>(pair) >> 16u) * (bitcast<i32>(weights) >> 16u);
    return f32(low + high);
}

fn row_of(table: u32, phase: u32) -> u32 {
    return table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT);
}

fn displacement_of(pairs: vec4<u32>, weights: u32) -> vec3<f32> {
    let unit = bitcast<f32>(pairs.w);
    return vec3<f32>(
        dot_halves(pairs.x, weights) * unit,
        dot_halves(pairs.y, weights) * unit,
        dot_halves(pairs.z, weights) * unit,
    );
}

fn motion_displacement(table: u32, phase: u32) -> vec3<f32> {
    return displacement_of(tables[scene.first_motion_row + 2u * row_of(table, phase)], weights_of(phase));
}

fn motion_period(table: u32) -> vec3<f32> {
    let end = row_of(table, 0u) + (TABLE_ROWS - 1u);
    return displacement_of(tables[scene.first_motion_row + 2u * end], weights_of(0u));
}

fn motion_state(table: u32, phase: u32) -> MotionState {
    let row = scene.first_motion_row + 2u * row_of(table, phase);
    let weights = weights_of(phase);
    let pairs = tables[row + 1u];
    let turn = vec4<f32>(
        dot_halves(pairs.x, weights) * PAIR_TURN_UNIT,
        dot_halves(pairs.y, weights) * PAIR_TURN_UNIT,
        dot_halves(pairs.z, weights) * PAIR_TURN_UNIT,
        dot_halves(pairs.w, weights) * PAIR_TURN_UNIT,
    );
    return MotionState(displacement_of(tables[row], weights), quat_renormalize(turn));
}

fn motion_velocity(table: u32, phase: u32) -> vec3<f32> {
    let first = scene.first_motion_row + scene.table_species * (2u * TABLES_PER_SPECIES * TABLE_ROWS);
    let row = first + row_of(table, phase);
    let a = bitcast<vec4<f32>>(tables[row]);
    let b = bitcast<vec4<f32>>(tables[row + 1u]);
    return vec3_lerp(vec3<f32>(a.x, a.y, a.z), vec3<f32>(b.x, b.y, b.z), fraction_of(phase));
}
