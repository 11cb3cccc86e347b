// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/cone_spiral.wgsl
//!
//! The cone spiral: a spiral that opens as the leaf falls (see [`ConeSpiral`](crate::motion::ConeSpiral)).
//!
//! Its phase is an age in 2^-16 steps, scaled by the leaf's size and speed as every phase is. Radius and angle of the spiral are closed
//! forms of the age; the phase of the table with heights and swings is a multiple of it. After 65,536 steps in the air the age is back at
//! zero, and another spiral begins about the place where the leaf is.

use bytemuck::must_cast_ref;

use super::record::{CONE_SPIRAL, HALF_MASK, heading_angle, leaf_primitive, leaf_species, motion_table};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, sin_cos_half, sin_cos_turns};
use crate::arith::quaternion::{Quat, quat_multiply, quat_turn_after};
use crate::arith::rng::mul_q16;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::motion::lookup::{PHASE_UNIT, motion_velocity};

crate::shared_constants! {
    /// Odd number that spreads headings over the phases of the swing, so that leaves neither swing together nor in time with their
    /// orbit: 2^32 over the golden ratio.
    pub const SWING_SPREAD: u32 = 0x9e37_79b1;
    /// Least share of the depth whose root is taken.
    pub const LEAST_SHARE: f32 = 1e-12;
    /// Radians of 2^-32 turns.
    pub const PHASE_RADIANS: f32 = 1.462_918e-9;
}

/// Cone spiral of a species, or of several leaves' (see [`ConesBlock`](crate::blocks::ConesBlock)).
#[derive(Clone, Copy)]
pub struct Cone<R: Real = f32> {
    /// Radius in m where it is open.
    pub radius_m: R,
    /// Share of the depth until there in 2^-16 steps.
    pub share_per_age: R,
    /// 1 on a bowl, 0 on a cone.
    pub is_bowl: R,
    /// Slope of the bank per m of radius.
    pub bank_per_m: R,
    /// Orbit in a step in 2^-32 turns.
    pub orbit_rate: R::Word,
    /// Phase of the table of heights and swings in a step.
    pub table_rate: R::Word,
    /// Age at which a leaf sets off.
    pub start_age: R::Word,
}

/// Returns true if leaves with these bits wind down in a cone spiral. Only of leaves in the air.
#[inline(always)]
pub fn winds<W: Word>(bits: W) -> W::Mask {
    leaf_primitive(bits).equals(CONE_SPIRAL)
}

/// Cone spiral of the species of leaves with these bits.
#[inline(always)]
pub fn cone_of<W: Word>(cx: &Context<'_>, bits: W) -> Cone<W::Real> {
    let (species, cones) = (leaf_species(bits), &cx.scene.cones);
    Cone {
        radius_m: species.pick(must_cast_ref(&cones.radius_m)),
        share_per_age: species.pick(must_cast_ref(&cones.share_per_age)),
        is_bowl: species.pick(must_cast_ref(&cones.is_bowl)),
        bank_per_m: species.pick(must_cast_ref(&cones.bank_per_m)),
        orbit_rate: species.pick(must_cast_ref(&cones.orbit_rate)).to_bits(),
        table_rate: species.pick(must_cast_ref(&cones.table_rate)).to_bits(),
        start_age: species.pick(must_cast_ref(&cones.start_age)).to_bits(),
    }
}

/// An age as a float, to its precision. In halves, which floats hold exactly.
#[inline(always)]
fn cone_age<W: Word>(age: W) -> W::Real {
    (age >> 16).to_real() * 65536.0 + (age & HALF_MASK).to_real()
}

/// Share of the depth of the cone that the leaf has come down at that age, at most 1.
#[inline(always)]
fn cone_share<W: Word>(cx: &Context<'_>, bits: W, age: W) -> W::Real {
    let cone = cone_of(cx, bits);
    let share = cone_age(age) * cone.share_per_age;
    share.min(share.all(1.0))
}

/// Radius of the spiral in m at that age, of a leaf of nominal size.
#[inline(always)]
pub fn cone_radius<W: Word>(cx: &Context<'_>, bits: W, age: W) -> W::Real {
    let cone = cone_of(cx, bits);
    let share = cone_share(cx, bits, age);
    let root = share * inverse_sqrt(share.max(share.all(LEAST_SHARE)));
    let is_bowl = share.all(0.5).less_than(cone.is_bowl);
    is_bowl.select_real(root, share) * cone.radius_m
}

/// Angle about +y at that age in 2^-32 turns, from the x axis.
#[inline(always)]
pub fn cone_angle<W: Word>(cx: &Context<'_>, bits: W, age: W, heading: W) -> W {
    mul_q16(age, cone_of(cx, bits).orbit_rate).plus(heading_angle(heading) << 16)
}

/// Phase of the table with heights and swings at that age.
#[inline(always)]
pub fn cone_table_phase<W: Word>(cx: &Context<'_>, bits: W, age: W, heading: W) -> W {
    mul_q16(age, cone_of(cx, bits).table_rate).plus(heading_angle(heading).times(age.all(SWING_SPREAD)))
}

/// Way in m from the spiral's axis to the leaf at that age, of a leaf of nominal size.
#[inline(always)]
pub fn cone_offset<W: Word>(cx: &Context<'_>, bits: W, age: W, heading: W) -> Vec3<W::Real> {
    let radius = cone_radius(cx, bits, age);
    let (sine, cosine) = sin_cos_turns(cone_angle(cx, bits, age, heading));
    Vec3::new(cosine * radius, radius.all(0.0), -(sine * radius))
}

/// Orientation at that age: the swing of the corners, the spin, a bank towards the axis as in a coordinated turn, and the place on
/// the orbit.
#[inline(always)]
pub fn cone_orientation<W: Word>(
    cx: &Context<'_>,
    bits: W,
    age: W,
    heading: W,
    swing: Quat<W::Real>,
    spin: W,
) -> Quat<W::Real> {
    let cone = cone_of(cx, bits);
    let slope = cone_radius(cx, bits, age) * cone.bank_per_m;
    let one = slope.all(1.0);
    let cosine = inverse_sqrt(slope * slope + one);
    let half_squared = (cosine + one) * 0.5;
    let inverse = inverse_sqrt(half_squared);
    let zero = slope.all(0.0);
    let bank = Quat::new(zero, zero, ((slope * cosine) * inverse) * 0.5, half_squared * inverse);
    let (spin_sine, spin_cosine) = sin_cos_half(spin);
    let banked = quat_multiply(bank, quat_turn_after(swing, spin_sine, spin_cosine));
    let (orbit_sine, orbit_cosine) = sin_cos_half(cone_angle(cx, bits, age, heading) >> 16);
    quat_turn_after(banked, orbit_sine, orbit_cosine)
}

/// Velocity at that age, in metres per step for a leaf of nominal size and speed.
#[inline(always)]
pub fn cone_velocity(cx: &Context<'_>, bits: u32, age: u32, heading: u32) -> Vec3 {
    let cone = cone_of(cx, bits);
    let per_step = cone.share_per_age * 65536.0;
    let radius = cone_radius(cx, bits, age);
    let share = cone_share(cx, bits, age);
    let full = cone.radius_m;
    // On a bowl r dr = R² ds / 2.
    let inverse = inverse_sqrt(share.max(LEAST_SHARE));
    let growth = if cone.is_bowl > 0.5 { inverse * 0.5 } else { 1.0 };
    let outward = if share < 1.0 { (full * per_step) * growth } else { 0.0 };
    let around = radius * (cone.orbit_rate.to_real() * PHASE_RADIANS);
    let (sine, cosine) = sin_cos_turns(cone_angle(cx, bits, age, heading));
    let phase = cone_table_phase(cx, bits, age, heading);
    let table = motion_velocity(&cx.motion, motion_table(bits), phase);
    Vec3::new(
        cosine * outward - sine * around,
        table.y * (cone.table_rate.to_real() * PHASE_UNIT),
        (-(sine * outward)) - cosine * around,
    )
}
