// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/motion/lookup.rs
#import bindings
#import kernel/quaternion

fn fraction_of(phase: u32) -> f32 {
    return f32(phase & PHASE_FRACTION_MASK) * PHASE_FRACTION_UNIT;
}

fn motion_vector_at(index: u32) -> vec3<f32> {
    let row = motion_rows[index];
    return vec3<f32>(row.x, row.y, row.z);
}

fn motion_displacement(table: u32, phase: u32) -> vec3<f32> {
    let row = 2u * (table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT));
    return vec3_lerp(motion_vector_at(row), motion_vector_at(row + 2u), fraction_of(phase));
}

fn motion_period(table: u32) -> vec3<f32> {
    return motion_vector_at(2u * (table * TABLE_ROWS + (TABLE_ROWS - 1u)));
}

fn motion_orientation(table: u32, phase: u32) -> vec4<f32> {
    let row = 2u * (table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT)) + 1u;
    let a = motion_rows[row];
    let b = motion_rows[row + 2u];
    let t = fraction_of(phase);
    return quat_renormalize(vec4<f32>(
        a.x + t * (b.x - a.x),
        a.y + t * (b.y - a.y),
        a.z + t * (b.z - a.z),
        a.w + t * (b.w - a.w),
    ));
}

fn motion_velocity(table: u32, phase: u32) -> vec3<f32> {
    let row = environment.motion.x + table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT);
    return vec3_lerp(motion_vector_at(row), motion_vector_at(row + 1u), fraction_of(phase));
}
