// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/own.wgsl
//!
//! A leaf's own motion: the tables scaled to its size and speed, turned to its heading, with its spin.

use super::record::{Course, HALF_MASK, SIZE_UNIT, SPIN_SHIFT, TABLE_MASK, TABLE_SHIFT};
use crate::context::Context;
use crate::kernel::math::sin_cos_turns;
use crate::kernel::quaternion::{Quat, quat_multiply};
use crate::kernel::rng::mul_q16;
use crate::kernel::vector::Vec3;
use crate::motion::lookup::{motion_orientation, motion_velocity};

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

/// Velocity of a leaf's own motion at a phase, in m/s.
#[inline(always)]
pub fn own_velocity(cx: &Context<'_>, bits: u32, phase: u32, course: Course) -> Vec3 {
    let local = motion_velocity(&cx.motion, (bits >> TABLE_SHIFT) & TABLE_MASK, phase);
    let per_second = (own_rate(cx, course.rate) >> 8) as f32 * cx.environment.time.0[2];
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
