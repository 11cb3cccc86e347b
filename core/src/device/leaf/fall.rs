// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/fall.wgsl
//!
//! A leaf in the air: its own motion from the tables, and the wind's drift.
//!
//! The leaf's velocity is its own motion's plus a drift that relaxes towards the wind within the response time
//! tau = U/g, exactly, as the air that it meets holds still during the step (see [`super::air`]). In still air the path does not
//! depend on dt.

use bytemuck::must_cast_ref;

use super::own::{
    MotionParams, STEP_UNIT, WHOLE_STEP, motion_params, on_grid, own_advance, own_orientation, own_rate,
};
use super::record::{Drift, Place, blend_steps_left, count_down_blend, leaf_species, spin_rate, turn_spin};
use super::settle::leaf_land;
use super::strike::leaf_strike;
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::reciprocal;
use crate::arith::quaternion::{Quat, quat_blend};
use crate::arith::rng::mul_q16;
use crate::arith::vector::{Vec3, vec3_dot};
use crate::context::Context;
use crate::device::solid::near::may_meet_solids;
use crate::device::terrain::ground::ground_met;
use crate::device::wind::packed::wind_unpack;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Twice the bits of 1e-20 m/s, a drift too slow to move any leaf.
    pub const SLOWEST_DRIFT_TWICE: u32 = 1e-20f32.to_bits() << 1;
}

/// A leaf on its way through one step, or several of them.
#[derive(Clone, Copy)]
pub struct Glide<R: Real = f32> {
    /// Position in metres.
    pub position: Vec3<R>,
    /// Drift velocity in m/s.
    pub drift: Vec3<R>,
    /// Phase.
    pub phase: R::Word,
}

/// A part of a step, and the response of the drift in it.
#[derive(Clone, Copy)]
pub struct Part<R: Real = f32> {
    /// Length in 2^-16 steps.
    pub length: u32,
    /// Drift kept.
    pub decay: R,
    /// Time constant of the response in s: distance per drift speed until none is left.
    pub tau: R,
}

/// Response of a leaf's species, or of several leaves' (see [`ResponseBlock`](crate::blocks::ResponseBlock)).
#[derive(Clone, Copy)]
pub struct Response<R: Real = f32> {
    /// Drift kept over a step.
    pub drift_kept: R,
    /// Fastest spin per step in 2^-18 turns, a whole number.
    pub fastest_spin: R,
    /// Time constant in s.
    pub time_constant_s: R,
    /// Its inverse in 1/s.
    pub inv_time_constant: R,
}

/// Response of the species of a leaf with these bits.
#[inline(always)]
pub fn response_of<W: Word>(cx: &Context<'_>, bits: W) -> Response<W::Real> {
    let (species, responses) = (leaf_species(bits), &cx.scene.responses);
    Response {
        drift_kept: species.pick(must_cast_ref(&responses.drift_kept)),
        fastest_spin: species.pick(must_cast_ref(&responses.fastest_spin)),
        time_constant_s: species.pick(must_cast_ref(&responses.time_constant_s)),
        inv_time_constant: species.pick(must_cast_ref(&responses.inv_time_constant)),
    }
}

/// A leaf on its way from where its records place it.
#[inline(always)]
pub fn glide_of(place: &Place, drift: &Drift) -> Glide {
    Glide { position: place.position.into(), drift: drift.velocity.into(), phase: drift.phase }
}

/// Drift relative to the air without components too slow to matter. They would fade to subnormal numbers, for which
/// processors take a hundred times as long and devices may take zero.
#[inline(always)]
pub fn felt_drift<R: Real>(drift: Vec3<R>) -> Vec3<R> {
    let felt = |part: R| {
        let bits = part.to_bits();
        let is_felt = !(bits << 1).less_than(bits.all(SLOWEST_DRIFT_TWICE));
        is_felt.select_real(part, part.all(0.0))
    };
    Vec3::new(felt(drift.x), felt(drift.y), felt(drift.z))
}

/// Moves a leaf through a part of a step within one stage.
#[inline(always)]
pub fn glide_part<R: Real>(
    cx: &Context<'_>,
    glide: Glide<R>,
    bits: R::Word,
    params: MotionParams<R::Word>,
    wind: Vec3<R>,
    part: Part<R>,
) -> Glide<R> {
    let rate = own_rate(cx, params.rate);
    let end = glide.phase.plus(mul_q16(rate, rate.all(part.length)));
    let own = own_advance(cx, bits, params, glide.phase, end);
    let before = felt_drift(glide.drift - wind);
    let after = before * part.decay;
    let spent = on_grid(before * part.tau) - on_grid(after * part.tau);
    let carried = wind * wind.x.all((part.length as f32 * STEP_UNIT) * cx.scene.dt_s);
    Glide { position: glide.position + ((own + spent) + carried), drift: wind + after, phase: end }
}

/// Spin angle one step on, in place in the bits.
#[inline(always)]
pub fn spin_advance<W: Word>(bits: W, heading: W, fastest: W::Real) -> W {
    let turn = spin_rate(heading).times(fastest.to_whole()).shift_signed(17);
    turn_spin(bits, turn)
}

/// Orientation after a step whose spin is done, and the bits with one step less to blend. `before` is only read where a
/// blend goes on.
#[inline(always)]
pub fn attitude_after<R: Real>(
    cx: &Context<'_>,
    bits: R::Word,
    phase: R::Word,
    heading: R::Word,
    before: impl Fn() -> Quat<R>,
) -> (R::Word, Quat<R>) {
    let goal = own_orientation(cx, bits, phase, heading);
    let steps_left = blend_steps_left(bits);
    let is_blending = steps_left.all(0).less_than(steps_left);
    if !is_blending.any() {
        return (bits, goal);
    }
    let mixed = quat_blend(before(), goal, reciprocal(steps_left.to_real()));
    let attitude = Quat::new(
        is_blending.select_real(mixed.x, goal.x),
        is_blending.select_real(mixed.y, goal.y),
        is_blending.select_real(mixed.z, goal.z),
        is_blending.select_real(mixed.w, goal.w),
    );
    (count_down_blend(bits, is_blending), attitude)
}

/// Writes back a leaf at the end of its step, with its spin and orientation there.
#[inline(always)]
pub fn glide_end(cx: &Context<'_>, leaf: &mut LeafMut<'_>, glide: Glide, bits: u32, heading: u32) {
    let spun = spin_advance(bits, heading, response_of(cx, bits).fastest_spin);
    let before = || Quat::from(leaf.attitude.quaternion);
    let (bits, attitude) = attitude_after(cx, spun, glide.phase, heading, before);
    leaf.attitude.quaternion = attitude.to_array();
    *leaf.place = Place { position: glide.position.to_array(), bits };
    *leaf.drift = Drift { velocity: glide.drift.to_array(), phase: glide.phase };
}

/// The whole step of falling leaves that have no event in it in that wind, up to the ground.
#[inline(always)]
pub fn glide_step<R: Real>(
    cx: &Context<'_>,
    glide: Glide<R>,
    bits: R::Word,
    params: MotionParams<R::Word>,
    response: Response<R>,
    wind: Vec3<R>,
) -> Glide<R> {
    let part = Part { length: WHOLE_STEP, decay: response.drift_kept, tau: response.time_constant_s };
    glide_part(cx, glide, bits, params, wind, part)
}

/// One step of a falling leaf that has no event in it, does not come to the ground, and is near no solid part. Others are left alone.
/// Returns true if the leaf has been moved.
#[inline(always)]
pub fn leaf_fall_aloft(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let (bits, heading) = (leaf.place.bits, leaf.schedule.heading);
    let glide = glide_of(leaf.place, leaf.drift);
    let (params, wind) = (motion_params(*leaf.schedule), wind_unpack(*leaf.air));
    let moved = glide_step(cx, glide, bits, params, response_of(cx, bits), wind);
    let way = moved.position - glide.position;
    let way_squared = vec3_dot(way, way);
    let is_near = cx.scene.has_solids() && may_meet_solids(cx, glide.position, way_squared);
    if ground_met(cx, moved.position) || is_near {
        return false;
    }
    glide_end(cx, leaf, moved, bits, heading);
    true
}

/// One step of a falling leaf that has no event in it, to the ground if it comes there. One that strikes a solid part is left to
/// [`leaf_fly`](super::fly::leaf_fly).
#[inline(always)]
pub fn leaf_fall(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let (start, bits, heading) = (Vec3::from(leaf.place.position), leaf.place.bits, leaf.schedule.heading);
    let glide = glide_of(leaf.place, leaf.drift);
    let (params, wind) = (motion_params(*leaf.schedule), wind_unpack(*leaf.air));
    let moved = glide_step(cx, glide, bits, params, response_of(cx, bits), wind);
    if leaf_strike(cx, leaf, moved.position) {
        return;
    }
    glide_end(cx, leaf, moved, bits, heading);
    if ground_met(cx, moved.position) {
        leaf_land(cx, leaf, start);
    }
}
