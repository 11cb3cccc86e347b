// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/own.wgsl
//!
//! A leaf's own motion: the tables scaled to its size and speed, turned to its heading, with its spin.

use super::cone_spiral::{cone_of, cone_offset, cone_orientation, cone_table_phase, cone_velocity, winds};
use super::record::{GRID_ANCHOR, HALF_MASK, Schedule, heading_angle, motion_table, size_ratio, spin_angle};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::sin_cos_half;
use crate::arith::quaternion::{Quat, quat_turn_after, quat_turn_before};
use crate::arith::rng::mul_q16;
use crate::arith::vector::{Vec3, vec3_select};
use crate::context::Context;
use crate::device::motion::lookup::{
    PHASE_UNIT, motion_displacement, motion_period, motion_state, motion_velocity,
};

crate::shared_constants! {
    /// A whole step in 2^-16 steps.
    pub const WHOLE_STEP: u32 = 65536;
    /// Inverse of it.
    pub const STEP_UNIT: f32 = 1.0 / 65536.0;
}

/// Parameters of a leaf's motion until its next event, or of several leaves': the last three words of their schedules.
#[derive(Clone, Copy, Debug)]
pub struct MotionParams<W = u32> {
    /// Phase per step.
    pub rate: W,
    /// Size word.
    pub size: W,
    /// Heading word.
    pub heading: W,
}

/// The motion parameters of a schedule.
#[inline(always)]
pub fn motion_params(schedule: Schedule) -> MotionParams {
    MotionParams { rate: schedule.rate, size: schedule.size, heading: schedule.heading }
}

/// A table vector turned by a heading in 2^-16 turns about +y.
#[inline(always)]
pub fn turn_to_heading<W: Word>(v: Vec3<W::Real>, angle: W) -> Vec3<W::Real> {
    let (half_sine, half_cosine) = sin_cos_half(angle);
    let twice = half_sine + half_sine;
    let sine = twice * half_cosine;
    let cosine = half_sine.all(1.0) - twice * half_sine;
    Vec3::new(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x)
}

/// Metres that a leaf moves per metre of its table.
#[inline(always)]
pub fn own_scale<W: Word>(cx: &Context<'_>, params: MotionParams<W>) -> W::Real {
    size_ratio(params.size) * cx.scene.displacement_gain
}

/// Phase per step with the scene's rotation speed.
#[inline(always)]
pub fn own_rate<W: Word>(cx: &Context<'_>, rate: W) -> W {
    let speed = cx.scene.rotation_speed_q16;
    if speed == WHOLE_STEP { rate } else { mul_q16(rate, rate.all(speed)) }
}

/// A displacement on the grid of 2^-18 m, for up to 16 m. Positions up to 64 m from the origin take up differences of
/// such displacements without rounding: so the sum over many steps is the difference of its ends, and a path does not
/// depend on the step length. (Rounded, the same small displacement step after step would be off by up to half a unit
/// in the last place each time, a millimetre and more over a fall.)
///
/// The twin holds the sum with the anchor in an integer, changed by a zero that shader compilers cannot know of: they
/// might take the anchor away from where it was just added and leave nothing of the rounding. Rust does not.
#[inline(always)]
pub fn on_grid<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(
        (v.x + GRID_ANCHOR) - GRID_ANCHOR,
        (v.y + GRID_ANCHOR) - GRID_ANCHOR,
        (v.z + GRID_ANCHOR) - GRID_ANCHOR,
    )
}

/// Phase at which a leaf with these bits begins its first motion, given a random word: the start of a cone spiral, else any.
#[inline(always)]
pub fn first_phase(cx: &Context<'_>, bits: u32, word: u32) -> u32 {
    if winds(bits) { cone_of(cx, bits).start_age } else { word }
}

/// Phase of a leaf's table at a phase of its motion.
#[inline(always)]
fn table_phase<W: Word>(cx: &Context<'_>, bits: W, phase: W, heading: W) -> W {
    if !cx.scene.has_cones() {
        return phase;
    }
    winds(bits).select(cone_table_phase(cx, bits, phase, heading), phase)
}

/// Displacement of a leaf's own motion over one whole period of its table, in metres.
#[inline(always)]
pub fn own_period<W: Word>(cx: &Context<'_>, bits: W, params: MotionParams<W>) -> Vec3<W::Real> {
    let local = motion_period(&cx.motion, motion_table(bits));
    on_grid(turn_to_heading(local, heading_angle(params.heading)) * own_scale(cx, params))
}

/// Displacement of a leaf's own motion from phase `start` to the later phase `end`, at most one period on, in metres. Of a cone spiral
/// whose age begins anew on the way, none.
#[inline(always)]
pub fn own_advance<W: Word>(
    cx: &Context<'_>,
    bits: W,
    params: MotionParams<W>,
    start: W,
    end: W,
) -> Vec3<W::Real> {
    let table = motion_table(bits);
    let angle = heading_angle(params.heading);
    let scale = own_scale(cx, params);
    let first = table_phase(cx, bits, start, params.heading);
    let last = table_phase(cx, bits, end, params.heading);
    let before = on_grid(turn_to_heading(motion_displacement(&cx.motion, table, first), angle) * scale);
    let after = on_grid(turn_to_heading(motion_state(&cx.motion, table, last).0, angle) * scale);
    let mut way = after - before;
    let wrapped = last.less_than(first);
    if wrapped.any() {
        way = way + own_period(cx, bits, params) * wrapped.select_real(scale.all(1.0), scale.all(0.0));
    }
    if !cx.scene.has_cones() {
        return way;
    }
    let inner = on_grid(cone_offset(cx, bits, start, params.heading) * scale);
    let outer = on_grid(cone_offset(cx, bits, end, params.heading) * scale);
    let wound = (way + (outer - inner)) * end.less_than(start).select_real(scale.all(0.0), scale.all(1.0));
    vec3_select(winds(bits), wound, way)
}

/// Velocity of a leaf's own motion at a phase, in m/s.
#[inline(always)]
pub fn own_velocity(cx: &Context<'_>, bits: u32, phase: u32, params: MotionParams) -> Vec3 {
    let rate = own_rate(cx, params.rate);
    // In halves, which floats hold exactly.
    let rounded = (rate >> 16) as f32 * 65536.0 + (rate & HALF_MASK) as f32;
    if winds(bits) {
        let local = cone_velocity(cx, bits, phase, params.heading);
        return local * (own_scale(cx, params) * ((rounded * STEP_UNIT) * cx.scene.inv_dt_s));
    }
    let local = motion_velocity(&cx.motion, motion_table(bits), phase);
    let periods_per_s = (rounded * PHASE_UNIT) * cx.scene.inv_dt_s;
    turn_to_heading(local, heading_angle(params.heading)) * (own_scale(cx, params) * periods_per_s)
}

/// Orientation of a leaf's own motion at a phase: spin, table and heading.
#[inline(always)]
pub fn own_orientation<W: Word>(cx: &Context<'_>, bits: W, phase: W, heading: W) -> Quat<W::Real> {
    let (_, local) = motion_state(&cx.motion, motion_table(bits), table_phase(cx, bits, phase, heading));
    let (heading_sine, heading_cosine) = sin_cos_half(heading_angle(heading));
    let (spin_sine, spin_cosine) = sin_cos_half(spin_angle(bits));
    let turned =
        quat_turn_before(quat_turn_after(local, heading_sine, heading_cosine), spin_sine, spin_cosine);
    if !cx.scene.has_cones() {
        return turned;
    }
    let wound = cone_orientation(cx, bits, phase, heading, local, spin_angle(bits));
    let is_wound = winds(bits);
    Quat::new(
        is_wound.select_real(wound.x, turned.x),
        is_wound.select_real(wound.y, turned.y),
        is_wound.select_real(wound.z, turned.z),
        is_wound.select_real(wound.w, turned.w),
    )
}
