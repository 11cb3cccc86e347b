// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/motion/lookup.wgsl
//!
//! Reads the packed motion tables at a phase. A phase is a `u32` in units of 2^-32 periods, so it wraps by itself.

use crate::arith::lane::Word;
use crate::arith::quaternion::{Quat, quat_renormalize};
use crate::arith::vector::{Vec3, vec3_lerp};
use crate::layout::Float4;
use crate::motion::table::{TABLE_BITS, TABLE_ROWS};

crate::shared_constants! {
    /// Periods per unit of a phase.
    pub const PHASE_UNIT: f32 = 1.0 / 4_294_967_296.0;
    /// Right shift that leaves the row of a phase.
    pub const PHASE_ROW_SHIFT: u32 = 32 - TABLE_BITS;
    /// Mask of a phase's place between two rows.
    pub const PHASE_FRACTION_MASK: u32 = (1 << PHASE_ROW_SHIFT) - 1;
    /// Unit of that place.
    pub const PHASE_FRACTION_UNIT: f32 = 1.0 / (1u32 << PHASE_ROW_SHIFT) as f32;
}

/// Packed tables, as kernels read them.
#[derive(Clone, Copy, Debug)]
pub struct MotionRows<'a> {
    /// For table t and row r at `513 t + r`: displacement, an unused number, orientation.
    pub states: &'a [[f32; 8]],
    /// For table t and row r at `513 t + r`: velocity, an unused number.
    pub velocities: &'a [[f32; 4]],
}

impl<'a> MotionRows<'a> {
    /// The rows of the packed tables, all states first, then all velocities.
    pub fn new(packed: &'a [Float4]) -> Self {
        let (states, velocities) = packed.split_at(packed.len() / 3 * 2);
        Self { states: bytemuck::cast_slice(states), velocities: bytemuck::cast_slice(velocities) }
    }
}

/// Place of a phase between two rows, 0 to 1.
#[inline(always)]
fn fraction_of<W: Word>(phase: W) -> W::Real {
    (phase & PHASE_FRACTION_MASK).to_real() * PHASE_FRACTION_UNIT
}

/// Row of a table before a phase.
#[inline(always)]
fn row_of<W: Word>(table: W, phase: W) -> W {
    table.times(table.all(TABLE_ROWS)).plus(phase >> PHASE_ROW_SHIFT)
}

/// Displacement in row `row + after`.
#[inline(always)]
fn displacement_in<W: Word>(motion: &MotionRows<'_>, row: W, after: usize) -> Vec3<W::Real> {
    let halves: &[[f32; 4]] = bytemuck::cast_slice(motion.states);
    let [x, y, z, _] = (row << 1).look_up(&halves[2 * after..]);
    Vec3::new(x, y, z)
}

/// Displacement since the start of the period at `phase`, in metres for a leaf of nominal size.
#[inline(always)]
pub fn motion_displacement<W: Word>(motion: &MotionRows<'_>, table: W, phase: W) -> Vec3<W::Real> {
    let row = row_of(table, phase);
    vec3_lerp(displacement_in(motion, row, 0), displacement_in(motion, row, 1), fraction_of(phase))
}

/// Displacement over one whole period.
#[inline(always)]
pub fn motion_period<W: Word>(motion: &MotionRows<'_>, table: W) -> Vec3<W::Real> {
    displacement_in(motion, row_of(table, table.all(0)), TABLE_ROWS as usize - 1)
}

/// Displacement and orientation at `phase`; the displacement is that of [`motion_displacement`].
#[inline(always)]
pub fn motion_state<W: Word>(motion: &MotionRows<'_>, table: W, phase: W) -> (Vec3<W::Real>, Quat<W::Real>) {
    let row = row_of(table, phase);
    let [dx, dy, dz, _, x, y, z, w] = row.look_up_blend(motion.states, fraction_of(phase));
    (Vec3::new(dx, dy, dz), quat_renormalize(Quat::new(x, y, z, w)))
}

/// Velocity at `phase`, in metres per period for a leaf of nominal size.
#[inline(always)]
pub fn motion_velocity(motion: &MotionRows<'_>, table: u32, phase: u32) -> Vec3 {
    let row = row_of(table, phase) as usize;
    let at = |row: usize| {
        let [x, y, z, _] = motion.velocities[row];
        Vec3::new(x, y, z)
    };
    vec3_lerp(at(row), at(row + 1), fraction_of(phase))
}
