// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/strike.wgsl
//!
//! Leaves and solid parts: what strikes one in its synthesised fall flies on as a body, what comes to rest on one is held there, and
//! what lies in the way of one that moves is pushed.

use super::at_rest::{LeafAtRest, leaf_at_rest, least_wake_square};
use super::launch::random_asymmetry;
use super::lie::{STREAM_LYING, own_raise, reach_down};
use super::record::{
    AERODYNAMIC, CHANGE_ADDED, CHANGE_NONE, CHANGE_WOKEN, Drift, STATE_FALLING, body_spin_words, held_bits,
    is_sunk, leaf_species, lies_still, lying_support_word, lying_word, place_bits, wake_speed_word,
    with_asymmetry, with_litter_change,
};
use super::settle::recycling_step;
use crate::arith::math::reciprocal;
use crate::arith::quaternion::Quat;
use crate::arith::rng::random;
use crate::arith::vector::Vec3;
use crate::blocks::NEVER;
use crate::context::Context;
use crate::device::flight::body::{LeafBody, body_of};
use crate::device::flight::strike::{Passage, deepest_overlap, first_strike, solid_gap};
use crate::device::solid::distance::solid_distance;
use crate::device::solid::near::{may_meet_movers, near_count, near_solid, solids_cell};
use crate::device::solid::shape::{SolidAt, solid_at};
use crate::device::terrain::ground::{Slope, ground_rest};
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Gap in m up to which a leaf touches what holds it.
    pub const TOUCH_M: f32 = 0.004;
    /// Least upward component of the normal of a surface that holds leaves.
    pub const LEAST_UPWARD: f32 = 0.3;
    /// Least friction coefficient of a surface that holds leaves.
    pub const LEAST_FRICTION_HELD: f32 = 0.05;
}

/// Lets a leaf that strikes a solid part in its synthesised step to `end` fly on from the step's start as a body, with the velocity of
/// that step. Returns true if it does.
#[inline(always)]
pub fn leaf_strike(cx: &Context<'_>, leaf: &mut LeafMut<'_>, end: Vec3) -> bool {
    if !cx.scene.has_solids() {
        return false;
    }
    let start = Vec3::from(leaf.place.position);
    let cell = solids_cell(cx, start);
    if near_count(cx, cell) == 0 {
        return false;
    }
    let size = with_asymmetry(leaf.schedule.size, random_asymmetry(cx, leaf.identity.id));
    let body = body_of(cx, leaf.place.bits, size);
    let pose = Quat::from(leaf.attitude.quaternion);
    let passage =
        Passage { from: start, way: end - start, seconds: 0.0, time: cx.scene.dt_s, reach_share: 1.0 };
    if 1.0 <= first_strike(cx, &body, pose, cell, &passage).share {
        return false;
    }
    let [x, y, z] = body_spin_words(Vec3::ZERO);
    leaf.place.bits = place_bits(STATE_FALLING, 0, AERODYNAMIC, leaf_species(leaf.place.bits), 0);
    *leaf.drift = Drift { velocity: ((end - start) * cx.scene.inv_dt_s).to_array(), phase: x };
    leaf.schedule.event = recycling_step(cx, leaf.identity);
    leaf.schedule.size = size;
    leaf.schedule.rate = y;
    leaf.schedule.heading = z;
    leaf.identity.fall_time = 0;
    true
}

/// Returns true if a body in a pose is inside a solid part at the step's start.
#[inline(always)]
pub fn is_inside_solid(cx: &Context<'_>, body: &LeafBody, pose: Quat, place: Vec3) -> bool {
    cx.scene.has_solids()
        && deepest_overlap(cx, body, pose, solids_cell(cx, place), place, 0.0).number != NEVER
}

/// Surface of a solid part that holds a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Footing {
    /// True if there is one.
    pub is_firm: bool,
    /// Its slope.
    pub slope: Slope,
    /// Its friction.
    pub friction: f32,
}

/// Footing of a body at a place on a part that stands still.
#[inline(always)]
pub fn solid_footing(cx: &Context<'_>, body: &LeafBody, pose: Quat, place: Vec3) -> Footing {
    let cell = solids_cell(cx, place);
    let mut nearest = TOUCH_M;
    let mut normal = Vec3::new(0.0, 1.0, 0.0);
    let mut footing =
        Footing { is_firm: false, slope: Slope { x: 0.0, z: 0.0, gain: 1.0, inv_gain: 1.0 }, friction: 0.0 };
    for entry in cx.scene.solids.mover_count..near_count(cx, cell) {
        let solid = solid_at(cx, near_solid(cx, cell, entry), 0.0);
        let gap = solid_gap(cx, &solid, body, pose, place, 1.0);
        if gap.gap_m < nearest && LEAST_UPWARD < gap.normal.y {
            nearest = gap.gap_m;
            normal = gap.normal;
            footing.is_firm = true;
            footing.friction = solid.friction.max(LEAST_FRICTION_HELD);
        }
    }
    let inverse = reciprocal(normal.y);
    let (x, z) = (-(normal.x * inverse), -(normal.z * inverse));
    let gain = 1.0 + (x * x + z * z);
    footing.slope = Slope { x, z, gain, inv_gain: reciprocal(gain) };
    footing
}

/// Returns true if a body at rest is above the ground: something else bears it.
#[inline(always)]
pub fn is_borne(cx: &Context<'_>, body: &LeafBody, pose: Quat, place: Vec3) -> bool {
    cx.scene.has_solids() && ground_rest(cx, place.x, place.z) + (reach_down(body, pose) + TOUCH_M) < place.y
}

/// A leaf at rest on a solid part.
#[derive(Clone, Copy, Debug)]
pub struct HeldAtRest {
    /// True if a part does hold it.
    pub is_firm: bool,
    /// The leaf.
    pub at_rest: LeafAtRest,
}

/// A leaf as it would be at rest where it is, on the solid part beneath.
#[inline(always)]
pub fn held_at_rest(cx: &Context<'_>, leaf: &LeafMut<'_>) -> HeldAtRest {
    let pose = Quat::from(leaf.attitude.quaternion);
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    let footing = solid_footing(cx, &body, pose, leaf.place.position.into());
    let raise = own_raise(cx, random(cx.scene.seed, leaf.identity.id, STREAM_LYING));
    let at_rest = leaf_at_rest(cx, body, pose, footing.slope, footing.friction, raise);
    HeldAtRest { is_firm: footing.is_firm, at_rest }
}

/// Lets a solid part hold a leaf at rest on it.
#[inline(always)]
pub fn leaf_rest_on(cx: &Context<'_>, leaf: &mut LeafMut<'_>, at_rest: &LeafAtRest) {
    let change = if cx.scene.has_living_litter() { CHANGE_ADDED } else { CHANGE_NONE };
    leaf.place.bits = with_litter_change(held_bits(leaf_species(leaf.place.bits)), change);
    *leaf.drift = Drift { velocity: [0.0; 3], phase: wake_speed_word(least_wake_square(cx, at_rest)) };
    leaf.schedule.rate = lying_support_word(reach_down(&at_rest.body, at_rest.pose));
    leaf.schedule.heading = lying_word(at_rest.friction, at_rest.raise);
}

/// Returns true if a solid part that moves comes upon a body in this step.
#[inline(always)]
pub fn comes_upon(cx: &Context<'_>, mover: &SolidAt, number: u32, place: Vec3, size_m: f32) -> bool {
    let way = cx.step.movers[number as usize].way_m;
    0.0 < way && solid_distance(cx, mover, place).distance_m < size_m + way
}

/// Wakes a leaf in the litter that a part which moves comes upon. Returns true if it does.
#[inline(always)]
pub fn leaf_push(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let bits = leaf.place.bits;
    let place = Vec3::from(leaf.place.position);
    if !lies_still(bits) || is_sunk(bits) || !may_meet_movers(cx, place) {
        return false;
    }
    let body = body_of(cx, bits, leaf.schedule.size);
    let size = body.half_mean_m * body.size_ratio;
    for number in 0..cx.scene.solids.mover_count {
        if comes_upon(cx, &solid_at(cx, number, 0.0), number, place, size) {
            leaf.place.bits = with_litter_change(bits, CHANGE_WOKEN);
            [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(Vec3::ZERO);
            return true;
        }
    }
    false
}
