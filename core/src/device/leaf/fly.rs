// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/fly.wgsl
//!
//! A leaf that flies as a body in the air: one step, in as many substeps as its speed and spin ask for.

use super::at_rest::{REST_SHARE_SQUARED, leaf_at_rest, slides_down, wind_moves};
use super::lie::{STREAM_LYING, flatten_to, leaf_rest, lying_tilt, own_friction, own_raise, reach_down};
use super::record::{
    Drift, body_spin, body_spin_words, flies, regime_state, size_ratio, touch_steps, with_regime,
    with_touch_steps,
};
use super::settle::leaf_land;
use super::strike::{held_at_rest, is_borne};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{Quat, quat_multiply, quat_rotate_back};
use crate::arith::rng::{mul_q16, random};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::context::Context;
use crate::device::flight::body::{LeafBody, body_of, body_row};
use crate::device::flight::contact::{Contacts, OverGround};
use crate::device::flight::rates::FlightMotion;
use crate::device::flight::regime::{regime_after, regime_in_spin, regime_of};
use crate::device::flight::runge_kutta::{MAX_SUBSTEPS, Substeps, flight_step, substep_count};
use crate::device::flight::strike::AmongSolids;
use crate::device::solid::near::may_meet_solids;
use crate::device::terrain::ground::{ground_is_water, ground_lean, ground_met, ground_rest, ground_slope};
use crate::device::terrain::litter::litter_height;
use crate::device::wind::pile_shadow::wind_behind_piles;
use crate::device::wind::sample::wind_at;
use crate::flight::block::BODY_LOAD_ROW;
use crate::leaf::LeafMut;

/// A body on its way, or several of them.
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

crate::shared_constants! {
    /// Speed in m/s that a body gains at most in a step besides that of the wind and its own through it: its weight and its spin give little.
    pub const FLIGHT_GAIN_M_S: f32 = 2.0;
}

/// Square in m² of the longest way that a body goes in a step in a wind: drag takes from its speed through the air, and lift adds none.
#[inline(always)]
pub fn longest_way_squared<R: Real>(cx: &Context<'_>, velocity: Vec3<R>, wind: Vec3<R>) -> R {
    let tiny = velocity.x.all(TINY_SQUARED);
    let slip = velocity - wind;
    let relative = vec3_dot(slip, slip).max(tiny);
    let carried = vec3_dot(wind, wind).max(tiny);
    let speed = (relative * inverse_sqrt(relative) + carried * inverse_sqrt(carried)) + FLIGHT_GAIN_M_S;
    let way = speed * cx.scene.dt_s;
    way * way
}

/// Load on a step: the number of substeps that it needs at least.
#[inline(always)]
pub fn flight_load<R: Real>(cx: &Context<'_>, bits: R::Word, relative: Vec3<R>, spin: Vec3<R>) -> R {
    let [per_speed, per_spin, ..] = body_row(cx, bits, BODY_LOAD_ROW);
    let tiny = per_speed.all(TINY_SQUARED);
    let squared = vec3_dot(relative, relative).max(tiny);
    let turned = vec3_dot(spin, spin).max(tiny);
    per_speed * (squared * inverse_sqrt(squared)) + per_spin * (turned * inverse_sqrt(turned))
}

/// Turning after a contact, no faster than the substeps of this step bear.
#[inline(always)]
fn bounded_turning<R: Real>(
    cx: &Context<'_>,
    bits: R::Word,
    body: &LeafBody<R>,
    substeps: &Substeps<R>,
    turning: Vec3<R>,
) -> Vec3<R> {
    let [_, per_spin, ..] = body_row(cx, bits, BODY_LOAD_ROW);
    let most = (substeps.count * body.size_ratio) * reciprocal(per_spin);
    let squared = vec3_dot(turning, turning).max(per_spin.all(TINY_SQUARED));
    let share = most * inverse_sqrt(squared);
    turning * share.min(per_spin.all(1.0))
}

/// Bodies after a step.
#[derive(Clone, Copy, Debug)]
pub struct Flown<R: Real = f32> {
    /// Their flight.
    pub flight: Flight<R>,
    /// True of those that touch the ground and hardly move. Only where there is litter.
    pub is_calm: R::Mask,
    /// True of those that touch water on which leaves float.
    pub is_wet: R::Mask,
}

/// The step of bodies, in wind that holds still during it.
#[inline(always)]
pub fn flight_advance<R: Real, C: Contacts<R>>(
    cx: &Context<'_>,
    flight: Flight<R>,
    bits: R::Word,
    size: R::Word,
    wind: Vec3<R>,
) -> Flown<R> {
    let body = body_of(cx, bits, size);
    let relative = flight.velocity - wind;
    let load = flight_load(cx, bits, relative, flight.spin);
    let substeps = substep_count(load);
    // If the largest number of substeps is too few (a mote in a tornado), relative wind and spin are clamped.
    let most = load.all(MAX_SUBSTEPS);
    let clamped = most.less_than(load).select_real(most * reciprocal(load), load.all(1.0));
    let wind = flight.velocity - relative * clamped;
    let turning = flight.spin * (body.size_ratio * clamped);
    let time = substeps.share * cx.scene.dt_s;
    let mut position = flight.position;
    let mut motion = FlightMotion { velocity: flight.velocity, pose: flight.pose, turning };
    let mut done = time.all(0.0);
    let mut touches = done.less_than(done);
    loop {
        let on = done.less_than(substeps.count);
        if !on.any() {
            break;
        }
        let (way, next) = flight_step(cx, &body, &motion, wind, time);
        let from = position;
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
        if cx.has_litter() {
            let contact = C::contact(cx, &body, from, way, motion, time * done, time);
            position = chosen(on, contact.position, position);
            motion.velocity = chosen(on, contact.motion.velocity, motion.velocity);
            motion.turning = chosen(
                on,
                bounded_turning(cx, bits, &body, &substeps, contact.motion.turning),
                motion.turning,
            );
            touches = touches | (on & contact.touches);
        }
        done = done + 1.0;
    }
    let flight = Flight {
        position,
        velocity: motion.velocity,
        pose: motion.pose,
        spin: motion.turning * body.inv_size_ratio,
    };
    let swing = flight.spin * ((body.half_mean_m * body.size_ratio) * 0.5);
    let energy = vec3_dot(flight.velocity, flight.velocity) + vec3_dot(swing, swing);
    let is_calm = touches & energy.less_than(energy.all(cx.scene.litter.rest_m2_s2));
    let mut is_wet = energy.less_than(energy);
    if cx.scene.leaves_float() && touches.any() {
        is_wet = touches & ground_is_water(cx, position.x, position.z);
    }
    Flown { flight, is_calm, is_wet }
}

/// State of a body's regime after a step, and its bits with that regime.
#[derive(Clone, Copy, Debug)]
pub struct Regime<W = u32> {
    /// State of the classification.
    pub state: W,
    /// Bits of the leaf.
    pub bits: W,
}

/// Classifies a body's motion after a step.
#[inline(always)]
pub fn update_regime<R: Real>(
    cx: &Context<'_>,
    flight: &Flight<R>,
    wind: Vec3<R>,
    state: R::Word,
    bits: R::Word,
    size: R::Word,
) -> Regime<R::Word> {
    let path = flight.velocity - wind;
    let flow = quat_rotate_back(flight.pose, path);
    let now = cx.step.index;
    let rate = cx.scene.ticks_per_step_q16;
    let ticks = mul_q16(now.wrapping_add(1), rate).wrapping_sub(mul_q16(now, rate));
    let [_, _, idle_timeout, _] = body_row(cx, bits, BODY_LOAD_ROW);
    let next = regime_after(state, flow, flight.spin, path, ticks, idle_timeout.to_whole());
    let [half_along_m, half_across_m, _, _] = body_row(cx, bits, 1);
    let reach_m = half_along_m.max(half_across_m) * size_ratio(size);
    let regime = regime_in_spin(regime_of(next), flow, flight.spin, reach_m);
    Regime { state: next, bits: with_regime(bits, regime) }
}

/// Bits of bodies with the steps for which they have been calm. Water holds those that touch it at once.
#[inline(always)]
pub fn count_calm_steps<W: Word>(cx: &Context<'_>, bits: W, is_calm: W::Mask, is_wet: W::Mask) -> W {
    if !cx.has_litter() {
        return bits;
    }
    let calm = is_calm.select(touch_steps(bits).plus(bits.all(1)), bits.all(0));
    with_touch_steps(bits, is_wet.select(bits.all(cx.scene.settle_steps), calm))
}

/// Returns true if bodies with these bits, at this place after a step, are done with flying: they have been calm for a while, or, where
/// there is no litter, have come to the ground.
#[inline(always)]
pub fn flight_ends<R: Real>(cx: &Context<'_>, bits: R::Word, position: Vec3<R>) -> R::Mask {
    if !cx.has_litter() {
        return ground_met(cx, position);
    }
    !touch_steps(bits).less_than(bits.all(cx.scene.settle_steps))
}

/// Lays a body down whose flight ends, on the ground or on a solid part, unless the wind would take it again; on water in any wind.
#[inline(always)]
fn leaf_end_flight(cx: &Context<'_>, leaf: &mut LeafMut<'_>, start: Vec3) {
    if !cx.has_litter() {
        leaf_land(cx, leaf, start);
        return;
    }
    let before = Quat::from(leaf.attitude.quaternion);
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    if is_borne(cx, &body, before, leaf.place.position.into()) {
        let held = held_at_rest(cx, leaf);
        let wind = wind_at(cx, leaf.place.position.into());
        if !held.is_firm
            || slides_down(&held.at_rest)
            || wind_moves(cx, &held.at_rest, wind, REST_SHARE_SQUARED)
        {
            leaf.place.bits = with_touch_steps(leaf.place.bits, 0);
        } else {
            leaf_rest(cx, leaf);
        }
        return;
    }
    let [x, _, z] = leaf.place.position;
    if cx.scene.leaves_float() && ground_is_water(cx, x, z) {
        leaf_rest(cx, leaf);
        return;
    }
    let words = random(cx.scene.seed, leaf.identity.id, STREAM_LYING);
    let slope = ground_slope(cx, x, z);
    let lean = quat_multiply(ground_lean(slope), lying_tilt(cx, words));
    let pose = flatten_to(lean, before, 0.0);
    let friction = own_friction(cx, words, litter_height(cx, x, z));
    let wind = wind_at(cx, Vec3::new(x, ground_rest(cx, x, z) + reach_down(&body, pose), z));
    let wind = wind_behind_piles(cx, x, z, wind);
    let at_rest = leaf_at_rest(cx, body, pose, slope, friction, own_raise(cx, words));
    if wind_moves(cx, &at_rest, wind, REST_SHARE_SQUARED) {
        leaf.place.bits = with_touch_steps(leaf.place.bits, 0);
    } else {
        leaf_rest(cx, leaf);
    }
}

/// `yes` where the mask is true, `no` elsewhere.
#[inline(always)]
fn chosen<R: Real>(mask: R::Mask, yes: Vec3<R>, no: Vec3<R>) -> Vec3<R> {
    Vec3::new(mask.select_real(yes.x, no.x), mask.select_real(yes.y, no.y), mask.select_real(yes.z, no.z))
}

/// A leaf's flight, out of its records.
#[inline(always)]
pub fn flight_of(leaf: &LeafMut<'_>) -> Flight {
    Flight {
        position: Vec3::from(leaf.place.position),
        velocity: Vec3::from(leaf.drift.velocity),
        pose: Quat::from(leaf.attitude.quaternion),
        spin: body_spin(leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading),
    }
}

/// Writes a flight into a leaf's records.
#[inline(always)]
pub fn flight_write(leaf: &mut LeafMut<'_>, flight: Flight) {
    let [x, y, z] = body_spin_words(flight.spin);
    leaf.place.position = flight.position.to_array();
    *leaf.drift = Drift { velocity: flight.velocity.to_array(), phase: x };
    leaf.attitude.quaternion = flight.pose.to_array();
    leaf.schedule.rate = y;
    leaf.schedule.heading = z;
}

/// One step of a leaf, if it flies as a body: others are left alone.
#[inline(always)]
pub fn leaf_fly(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if !flies(leaf.place.bits) {
        return;
    }
    let start = flight_of(leaf);
    let wind = wind_at(cx, start.position);
    let (bits, size) = (leaf.place.bits, leaf.schedule.size);
    let is_among_solids = cx.scene.has_solids()
        && may_meet_solids(cx, start.position, longest_way_squared(cx, start.velocity, wind));
    let Flown { flight, is_calm, is_wet } = if is_among_solids {
        flight_advance::<f32, AmongSolids>(cx, start, bits, size, wind)
    } else {
        flight_advance::<f32, OverGround>(cx, start, bits, size, wind)
    };
    flight_write(leaf, flight);
    let before = regime_state(leaf.identity.fall_time);
    let regime = update_regime(cx, &flight, wind, before, bits, size);
    leaf.identity.fall_time = regime.state;
    leaf.place.bits = count_calm_steps(cx, regime.bits, is_calm, is_wet);
    if flight_ends(cx, leaf.place.bits, flight.position) {
        leaf_end_flight(cx, leaf, start.position);
    }
}
