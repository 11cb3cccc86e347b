// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/motion/lookup.wgsl
//!
//! Reads the packed motion tables at a phase. A phase is a `u32` in units of 2^-32 periods, so it wraps by itself.
//!
//! A row holds numbers of 16 bits in pairs, each with that of the next row, so that one row is read where there would be two. A
//! displacement is right to 2^-16 of the longest way in its table.

use crate::arith::lane::{Real, Word};
use crate::arith::quaternion::{Quat, quat_renormalize};
use crate::arith::vector::{Vec3, vec3_lerp};
use crate::layout::Uint4;
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
    /// Sum of the weights of two rows. With numbers of 16 bits weighted sums stay below 2^24, which floats hold exactly.
    pub const PAIR_WEIGHT: u32 = 512;
    /// Right shift that leaves row and weight of a phase.
    pub const PAIR_WEIGHT_SHIFT: u32 = PHASE_ROW_SHIFT - PAIR_WEIGHT.trailing_zeros();
    /// Largest number of a pair.
    pub const LARGEST_HALF: f32 = 32767.0;
    /// Unit of weighted components of quaternions.
    pub const PAIR_TURN_UNIT: f32 = 1.0 / (LARGEST_HALF * PAIR_WEIGHT as f32);
}

/// Packed tables, as kernels read them.
#[derive(Clone, Copy, Debug)]
pub struct MotionRows<'a> {
    /// For table t and row r at `2 (513 t + r)`: pairs of displacements x, y, z, and as a float the unit of their weighted sums in m;
    /// behind it pairs of orientations x, y, z, w.
    pub states: &'a [[u32; 4]],
    /// For table t and row r at `513 t + r`: velocity, an unused number.
    pub velocities: &'a [[f32; 4]],
}

impl<'a> MotionRows<'a> {
    /// The rows of the packed tables, all states first, then all velocities.
    pub fn new(packed: &'a [Uint4]) -> Self {
        let (states, velocities) = packed.split_at(packed.len() / 3 * 2);
        Self { states: bytemuck::cast_slice(states), velocities: bytemuck::cast_slice(velocities) }
    }
}

/// Place of a phase between two rows, 0 to 1.
#[inline(always)]
fn fraction_of<W: Word>(phase: W) -> W::Real {
    (phase & PHASE_FRACTION_MASK).to_real() * PHASE_FRACTION_UNIT
}

/// Weights of the rows before and after a phase, in the halves of a word.
#[inline(always)]
fn weights_of<W: Word>(phase: W) -> W {
    let after = (phase >> PAIR_WEIGHT_SHIFT) & (PAIR_WEIGHT - 1);
    phase.all(PAIR_WEIGHT).minus(after) | (after << 16)
}

/// Sum of a pair of numbers times their weights.
#[inline(always)]
fn dot_halves<W: Word>(pair: W, weights: W) -> W::Real {
    pair.dot_halves(weights)
}

/// Row of a table before a phase.
#[inline(always)]
fn row_of<W: Word>(table: W, phase: W) -> W {
    table.times(table.all(TABLE_ROWS)).plus(phase >> PHASE_ROW_SHIFT)
}

/// Displacement of a row's pairs, by these weights.
#[inline(always)]
fn displacement_of<W: Word>([x, y, z, unit]: [W; 4], weights: W) -> Vec3<W::Real> {
    let unit = W::Real::from_bits(unit);
    Vec3::new(dot_halves(x, weights) * unit, dot_halves(y, weights) * unit, dot_halves(z, weights) * unit)
}

/// Displacement since the start of the period at `phase`, in metres for a leaf of nominal size.
#[inline(always)]
pub fn motion_displacement<W: Word>(motion: &MotionRows<'_>, table: W, phase: W) -> Vec3<W::Real> {
    let pairs = (row_of(table, phase) << 1).look_up_words(motion.states);
    displacement_of(pairs, weights_of(phase))
}

/// Displacement over one whole period.
#[inline(always)]
pub fn motion_period<W: Word>(motion: &MotionRows<'_>, table: W) -> Vec3<W::Real> {
    let end = row_of(table, table.all(0)).plus(table.all(TABLE_ROWS - 1));
    let pairs = (end << 1).look_up_words(motion.states);
    displacement_of(pairs, weights_of(table.all(0)))
}

/// Displacement and orientation at `phase`; the displacement is that of [`motion_displacement`].
#[inline(always)]
pub fn motion_state<W: Word>(motion: &MotionRows<'_>, table: W, phase: W) -> (Vec3<W::Real>, Quat<W::Real>) {
    let weights = weights_of(phase);
    let [pairs, [x, y, z, w]] = (row_of(table, phase) << 1).look_up_two(motion.states);
    let part = |pair: W| dot_halves(pair, weights) * PAIR_TURN_UNIT;
    let turn = Quat::new(part(x), part(y), part(z), part(w));
    (displacement_of(pairs, weights), quat_renormalize(turn))
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
