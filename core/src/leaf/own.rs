// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/own.wgsl
//!
//! A leaf's own motion: the tables scaled to its size and speed, turned to its heading, with its spin.

use super::record::{Course, GRID_ANCHOR, HALF_MASK, SIZE_UNIT, SPIN_SHIFT, TABLE_MASK, TABLE_SHIFT};
use crate::context::Context;
use crate::kernel::math::sin_cos_turns;
use crate::kernel::quaternion::{Quat, quat_multiply};
use crate::kernel::rng::mul_q16;
use crate::kernel::vector::Vec3;
use crate::motion::lookup::{motion_displacement, motion_orientation, motion_period, motion_velocity};

/// A table vector turned by a heading in 2^-16 turns about +y.
#[inline(always)]
pub fn turn_to_heading(v: Vec3, heading: u32) -> Vec3 {
    let (sine, cosine) = sin_cos_turns(heading << 16);
    Vec3::new(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x)
}

/// Metres that a leaf moves per metre of its table.
#[inline(always)]
pub fn own_scale(cx: &Context<'_>, course: Course) -> f32 {
    ((course.size & HALF_MASK) as f32 * SIZE_UNIT) * cx.environment.time.0[3]
}

/// Phase per step with the scene's rotation speed.
#[inline(always)]
pub fn own_rate(cx: &Context<'_>, rate: u32) -> u32 {
    mul_q16(rate, cx.environment.counts.0[3])
}

/// A displacement on the grid of 2^-18 m, for up to 16 m. Positions up to 64 m from the origin take up differences of
/// such displacements without rounding: so the sum over many steps is the difference of its ends, and a path does not
/// depend on the step length. (Rounded, the same small displacement step after step would be off by up to half a unit
/// in the last place each time, a millimetre and more over a fall.)
///
/// The sum with the anchor is held in an integer, changed by a zero that compilers cannot know of: they might take the
/// anchor away from where it was just added and leave nothing of the rounding.
#[inline(always)]
pub fn on_grid(cx: &Context<'_>, v: Vec3) -> Vec3 {
    let zero = cx.environment.motion.0[1];
    Vec3::new(
        f32::from_bits((v.x + GRID_ANCHOR).to_bits() | zero) - GRID_ANCHOR,
        f32::from_bits((v.y + GRID_ANCHOR).to_bits() | zero) - GRID_ANCHOR,
        f32::from_bits((v.z + GRID_ANCHOR).to_bits() | zero) - GRID_ANCHOR,
    )
}

/// Displacement of a leaf's own motion over one whole period, in metres.
#[inline(always)]
pub fn own_period(cx: &Context<'_>, bits: u32, course: Course) -> Vec3 {
    let local = motion_period(&cx.motion, (bits >> TABLE_SHIFT) & TABLE_MASK);
    on_grid(cx, turn_to_heading(local, course.heading >> 16) * own_scale(cx, course))
}

/// Displacement of a leaf's own motion from phase `start` to the later phase `end`, at most one period on, in metres.
#[inline(always)]
pub fn own_advance(cx: &Context<'_>, bits: u32, course: Course, start: u32, end: u32) -> Vec3 {
    let table = (bits >> TABLE_SHIFT) & TABLE_MASK;
    let heading = course.heading >> 16;
    let scale = own_scale(cx, course);
    let before = on_grid(cx, turn_to_heading(motion_displacement(&cx.motion, table, start), heading) * scale);
    let after = on_grid(cx, turn_to_heading(motion_displacement(&cx.motion, table, end), heading) * scale);
    let wrapped = if end < start { 1.0 } else { 0.0 };
    (after - before) + own_period(cx, bits, course) * wrapped
}

/// Velocity of a leaf's own motion at a phase, in m/s.
#[inline(always)]
pub fn own_velocity(cx: &Context<'_>, bits: u32, phase: u32, course: Course) -> Vec3 {
    let local = motion_velocity(&cx.motion, (bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let rate = own_rate(cx, course.rate);
    // In halves, which floats hold exactly.
    let rounded = (rate >> 16) as f32 * 65536.0 + (rate & HALF_MASK) as f32;
    let per_second = rounded * cx.environment.time.0[2];
    turn_to_heading(local, course.heading >> 16) * (own_scale(cx, course) * per_second)
}

/// Orientation of a leaf's own motion at a phase: table, heading and spin.
#[inline(always)]
pub fn own_orientation(cx: &Context<'_>, bits: u32, phase: u32, heading: u32) -> Quat {
    let local = motion_orientation(&cx.motion, (bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let (heading_sine, heading_cosine) = sin_cos_turns((heading >> 16) << 15);
    let (spin_sine, spin_cosine) = sin_cos_turns((bits >> SPIN_SHIFT) << 15);
    let turned = quat_multiply(Quat::new(0.0, heading_sine, 0.0, heading_cosine), local);
    quat_multiply(turned, Quat::new(0.0, spin_sine, 0.0, spin_cosine))
}
