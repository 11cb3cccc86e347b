// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/fly.wgsl
//!
//! A leaf that flies as a body in the air: one step, cut as finely as its speed and spin ask for.

use super::record::{
    AERODYNAMIC, PRIMITIVE_MASK, PRIMITIVE_SHIFT, REGIME_MASK, REGIME_SHIFT, STATE_FALLING, STATE_MASK,
};
use super::settle::leaf_land;
use super::store::LeafMut;
use crate::context::Context;
use crate::flight::block::BODY_LOAD_ROW;
use crate::flight::body::{body_of, body_row};
use crate::flight::rates::FlightMotion;
use crate::flight::regime::{regime_memory, regime_of};
use crate::flight::runge_kutta::{FLIGHT_CUTS, flight_cuts, flight_step};
use crate::kernel::lane::{Mask, Real, Word};
use crate::kernel::math::{inverse_sqrt, reciprocal};
use crate::kernel::quaternion::{Quat, quat_rotate_back};
use crate::kernel::rng::mul_q16;
use crate::kernel::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::terrain::ground::ground_met;
use crate::wind::sample::wind_at;

/// A body on its way, or eight of them.
#[derive(Clone, Copy, Debug)]
pub struct Flight<R: Real = f32> {
    /// Position in metres.
    pub position: Vec3<R>,
    /// Velocity in m/s.
    pub velocity: Vec3<R>,
    /// Orientation.
    pub pose: Quat<R>,
    /// Spin about the leaf's own axes in rad/s.
    pub spin: Vec3<R>,
}

/// Whether leaves with these bits fly as bodies.
#[inline(always)]
pub fn flies<W: Word>(bits: W) -> W::Mask {
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))).equals(flying)
}

/// Load on a step: what it has to be cut for.
#[inline(always)]
pub fn flight_load<R: Real>(cx: &Context<'_>, bits: R::Word, relative: Vec3<R>, spin: Vec3<R>) -> R {
    let [per_speed, per_spin, ..] = body_row(cx, bits, BODY_LOAD_ROW);
    let tiny = per_speed.all(TINY_SQUARED);
    let squared = vec3_dot(relative, relative).max(tiny);
    let turned = vec3_dot(spin, spin).max(tiny);
    per_speed * (squared * inverse_sqrt(squared)) + per_spin * (turned * inverse_sqrt(turned))
}

/// The step of bodies, in wind that holds still during it: where they come to.
#[inline(always)]
pub fn flight_advance<R: Real>(
    cx: &Context<'_>,
    flight: Flight<R>,
    bits: R::Word,
    size: R::Word,
    wind: Vec3<R>,
) -> Flight<R> {
    let body = body_of(cx, bits, size);
    let relative = flight.velocity - wind;
    let load = flight_load(cx, bits, relative, flight.spin);
    let [cuts, share] = flight_cuts(load);
    // What even the finest cut does not bear (a mote in a tornado) is met by slower air.
    let bearable = load.all(FLIGHT_CUTS);
    let calm = bearable.less_than(load).select_real(bearable * reciprocal(load), load.all(1.0));
    let wind = flight.velocity - relative * calm;
    let turning = flight.spin * (body.size_ratio * calm);
    let time = share * cx.environment.dt_s;
    let mut position = flight.position;
    let mut motion = FlightMotion { velocity: flight.velocity, pose: flight.pose, turning };
    let mut done = cuts.all(0.0);
    loop {
        let on = done.less_than(cuts);
        if !on.any() {
            break;
        }
        let (way, next) = flight_step(&body, &motion, wind, time);
        position = chosen(on, position + way, position);
        motion = FlightMotion {
            velocity: chosen(on, next.velocity, motion.velocity),
            pose: Quat::new(
                on.select_real(next.pose.x, motion.pose.x),
                on.select_real(next.pose.y, motion.pose.y),
                on.select_real(next.pose.z, motion.pose.z),
                on.select_real(next.pose.w, motion.pose.w),
            ),
            turning: chosen(on, next.turning, motion.turning),
        };
        done = done + 1.0;
    }
    Flight {
        position,
        velocity: motion.velocity,
        pose: motion.pose,
        spin: motion.turning * body.inv_size_ratio,
    }
}

/// What a body remembers after a step, and its bits with the regime that this tells of.
#[inline(always)]
pub fn flight_told<R: Real>(
    cx: &Context<'_>,
    flight: &Flight<R>,
    wind: Vec3<R>,
    memory: R::Word,
    bits: R::Word,
) -> [R::Word; 2] {
    let path = flight.velocity - wind;
    let flow = quat_rotate_back(flight.pose, path);
    let now = cx.step.index;
    let rate = cx.environment.ticks_per_step_q16;
    let ticks = mul_q16(now.wrapping_add(1), rate).wrapping_sub(mul_q16(now, rate));
    let [_, _, idle_timeout, _] = body_row(cx, bits, BODY_LOAD_ROW);
    let told = regime_memory(memory, flow, flight.spin, path, ticks, idle_timeout.to_whole());
    [told, (bits & !(REGIME_MASK << REGIME_SHIFT)) | (regime_of(told) << REGIME_SHIFT)]
}

/// `yes` where the mask is true, `no` elsewhere.
#[inline(always)]
fn chosen<R: Real>(mask: R::Mask, yes: Vec3<R>, no: Vec3<R>) -> Vec3<R> {
    Vec3::new(mask.select_real(yes.x, no.x), mask.select_real(yes.y, no.y), mask.select_real(yes.z, no.z))
}

/// A leaf's flight as its records hold it.
#[inline(always)]
pub fn flight_of(leaf: &LeafMut<'_>) -> Flight {
    Flight {
        position: Vec3::from(leaf.place.position),
        velocity: Vec3::from(leaf.drift.velocity),
        pose: Quat::from(leaf.attitude.quaternion),
        spin: Vec3::new(
            f32::from_bits(leaf.drift.phase),
            f32::from_bits(leaf.course.rate),
            f32::from_bits(leaf.course.heading),
        ),
    }
}

/// Writes a flight into a leaf's records.
#[inline(always)]
pub fn flight_write(leaf: &mut LeafMut<'_>, flight: Flight) {
    leaf.place.position = flight.position.to_array();
    leaf.drift.velocity = flight.velocity.to_array();
    leaf.drift.phase = flight.spin.x.to_bits();
    leaf.attitude.quaternion = flight.pose.to_array();
    leaf.course.rate = flight.spin.y.to_bits();
    leaf.course.heading = flight.spin.z.to_bits();
}

/// One step of a leaf, if it flies as a body: others are left alone.
#[inline(always)]
pub fn leaf_fly(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if !flies(leaf.place.bits) {
        return;
    }
    let start = flight_of(leaf);
    let wind = wind_at(cx, start.position);
    let flight = flight_advance(cx, start, leaf.place.bits, leaf.course.size, wind);
    flight_write(leaf, flight);
    let [memory, bits] = flight_told(cx, &flight, wind, leaf.identity.fall_time, leaf.place.bits);
    leaf.identity.fall_time = memory;
    leaf.place.bits = bits;
    if ground_met(cx, flight.position) {
        leaf_land(cx, leaf, start.position);
    }
}
