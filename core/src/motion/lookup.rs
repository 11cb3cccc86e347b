// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/motion/lookup.wgsl
//!
//! Reads the packed motion tables at a phase. A phase is a `u32` in units of 2^-32 periods, so it wraps by itself.

use super::table::{TABLE_BITS, TABLE_ROWS};
use crate::kernel::quaternion::{Quat, quat_renormalize};
use crate::kernel::vector::{Vec3, vec3_lerp};
use crate::layout::Float4;

crate::shared_constants! {
    /// Right shift that leaves the row of a phase.
    pub const PHASE_ROW_SHIFT: u32 = 32 - TABLE_BITS;
    /// Mask of a phase's place between two rows.
    pub const PHASE_FRACTION_MASK: u32 = (1 << PHASE_ROW_SHIFT) - 1;
    /// Unit of that place.
    pub const PHASE_FRACTION_UNIT: f32 = 1.0 / (1u32 << PHASE_ROW_SHIFT) as f32;
}

/// Packed tables: for table t and row r the displacement at `2 (513 t + r)` and the orientation behind it; after all
/// tables, the velocity of row r at `velocity_first + 513 t + r`.
#[derive(Clone, Copy, Debug)]
pub struct MotionRows<'a> {
    /// All rows.
    pub rows: &'a [Float4],
    /// Index of the first velocity.
    pub velocity_first: u32,
}

/// Where a phase lies in a table.
#[inline(always)]
fn fraction_of(phase: u32) -> f32 {
    (phase & PHASE_FRACTION_MASK) as f32 * PHASE_FRACTION_UNIT
}

#[inline(always)]
fn vector_at(rows: &[Float4], index: u32) -> Vec3 {
    let row = rows[index as usize].0;
    Vec3::new(row[0], row[1], row[2])
}

/// Displacement since the start of the period at `phase`, in metres for a leaf of nominal size.
#[inline(always)]
pub fn motion_displacement(motion: &MotionRows<'_>, table: u32, phase: u32) -> Vec3 {
    let row = 2 * (table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT));
    vec3_lerp(vector_at(motion.rows, row), vector_at(motion.rows, row + 2), fraction_of(phase))
}

/// Displacement over one whole period.
#[inline(always)]
pub fn motion_period(motion: &MotionRows<'_>, table: u32) -> Vec3 {
    vector_at(motion.rows, 2 * (table * TABLE_ROWS + (TABLE_ROWS - 1)))
}

/// Orientation at `phase`.
#[inline(always)]
pub fn motion_orientation(motion: &MotionRows<'_>, table: u32, phase: u32) -> Quat {
    let row = 2 * (table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT)) + 1;
    let a = motion.rows[row as usize].0;
    let b = motion.rows[(row + 2) as usize].0;
    let t = fraction_of(phase);
    quat_renormalize(Quat::new(
        a[0] + t * (b[0] - a[0]),
        a[1] + t * (b[1] - a[1]),
        a[2] + t * (b[2] - a[2]),
        a[3] + t * (b[3] - a[3]),
    ))
}

/// Velocity at `phase`, in metres per period for a leaf of nominal size.
#[inline(always)]
pub fn motion_velocity(motion: &MotionRows<'_>, table: u32, phase: u32) -> Vec3 {
    let row = motion.velocity_first + table * TABLE_ROWS + (phase >> PHASE_ROW_SHIFT);
    vec3_lerp(vector_at(motion.rows, row), vector_at(motion.rows, row + 1), fraction_of(phase))
}
