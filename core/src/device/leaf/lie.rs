// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/lie.wgsl
//!
//! A leaf comes to rest on litter or on the ground that may bear some: it slides while the steepest drop within one cell exceeds
//! its friction, lies down tilted as its own curl has it, and waits for the litter to take its volume.

use super::afloat::{floats_at, leaf_set_afloat};
use super::at_rest::{leaf_at_rest, least_wake_square};
use super::launch::random_asymmetry;
use super::record::{
    CHANGE_ADDED, HALF_MASK, LYING, STATE_RESTING, ground_steps, leaf_species, lying_support_word,
    lying_word, place_bits, size_ratio, wake_speed_word, with_asymmetry, with_blend, with_litter_change,
    with_state,
};
use super::settle::{Friction, flatten, recycling_step, slide};
use super::strike::{held_at_rest, is_borne, is_inside_solid, leaf_rest_on};
use crate::arith::math::{reciprocal, sin_cos_turns};
use crate::arith::quaternion::{Quat, quat_multiply, quat_rotate_back};
use crate::arith::rng::{mul_high, random, unit_float};
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::flight::body::{LeafBody, body_of, body_row};
use crate::device::flight::contact::{contact_friction, support};
use crate::device::terrain::ground::{Slope, ground_bare, ground_lean, ground_slope, lying_height};
use crate::device::terrain::litter::{LITTER_HIGHEST_M, litter_cell, litter_height};
use crate::flight::block::BODY_LITTER_ROW;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Random words of a leaf's own tilt and friction on the ground.
    pub const STREAM_LYING: u32 = 36;
    /// Shift of the angle of the edges to half of the tilt of the leaf: the tilt is a quarter of it.
    pub const TILT_SHIFT: u32 = 3;
    /// Least friction of a leaf relative to the scene's; the largest is as far above.
    pub const LEAST_FRICTION: f32 = 0.85;
    /// Height in m within which a leaf that sinks has come down.
    pub const SUNK_M: f32 = 1e-4;
}

/// Angle in 2^-16 turns by which the edges of a leaf stand up, by its own words.
#[inline(always)]
pub fn own_raise(cx: &Context<'_>, words: [u32; 4]) -> u32 {
    let litter = &cx.scene.litter;
    litter.least_raise + mul_high(words[0], litter.raise_spread + 1)
}

/// The leaf's own tilt out of the surface that it lies on: the more its edges stand up, the larger.
#[inline(always)]
pub fn lying_tilt(cx: &Context<'_>, words: [u32; 4]) -> Quat {
    let (sine, cosine) = sin_cos_turns((own_raise(cx, words) << 16) >> TILT_SHIFT);
    let (axis_sine, axis_cosine) = sin_cos_turns(words[1]);
    Quat::new(sine * axis_cosine, 0.0, sine * axis_sine, cosine)
}

/// Friction of a leaf on what lies `depth` metres deep, by its own words.
#[inline(always)]
pub fn own_friction(cx: &Context<'_>, words: [u32; 4], depth: f32) -> f32 {
    let share = LEAST_FRICTION + unit_float(words[2]) * (2.0 - (LEAST_FRICTION + LEAST_FRICTION));
    contact_friction(cx, depth) * share
}

/// One step towards lying in a pose, face up or face down.
#[inline(always)]
pub fn flatten_to(lean: Quat, q: Quat, kept: f32) -> Quat {
    let back = Quat::new(-lean.x, -lean.y, -lean.z, lean.w);
    quat_multiply(lean, flatten(quat_multiply(back, q), kept))
}

/// Depth in m to which a leaf in a pose reaches down from its centre.
#[inline(always)]
pub fn reach_down(body: &LeafBody, pose: Quat) -> f32 {
    support(body, quat_rotate_back(pose, Vec3::new(0.0, 1.0, 0.0))).0
}

/// Begins to lay a body down where it is, nearly at rest.
#[inline(always)]
pub fn leaf_rest(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    leaf.place.bits = with_state(with_blend(leaf.place.bits & HALF_MASK, 0), STATE_RESTING);
    leaf.drift.velocity[1] = 0.0;
    leaf.drift.phase = 0;
    leaf.schedule.event = recycling_step(cx, leaf.identity);
}

/// One step of a leaf that slides or lies down where there may be litter.
#[inline(always)]
pub fn leaf_settle_on_litter(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let words = random(cx.scene.seed, leaf.identity.id, STREAM_LYING);
    let position = leaf.place.position;
    let leaning = Quat::from(leaf.attitude.quaternion);
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    if is_borne(cx, &body, leaning, position.into()) {
        let held = held_at_rest(cx, leaf);
        if held.is_firm {
            leaf_rest_on(cx, leaf, &held.at_rest);
            return;
        }
    }
    let slope = ground_slope(cx, position[0], position[2]);
    let own = own_friction(cx, words, litter_height(cx, position[0], position[2]));
    let loss = own * cx.scene.gravity_m_s2;
    let friction = Friction { loss_m_s2: loss, stop_s2_m: 0.5 * reciprocal(loss) };
    let (slid, left) = slide(cx, leaf.drift.velocity.into(), cx.scene.dt_s, slope, friction);
    let lean = quat_multiply(ground_lean(slope), lying_tilt(cx, words));
    let lying = flatten_to(lean, leaning, cx.scene.tilt_kept);
    // What would slide or turn into a solid part stays leaning on it.
    let is_blocked =
        is_inside_solid(cx, &body, lying, Vec3::new(position[0] + slid.x, position[1], position[2] + slid.z));
    let pose = if is_blocked { leaning } else { lying };
    let (x, z) =
        if is_blocked { (position[0], position[2]) } else { (position[0] + slid.x, position[2] + slid.z) };
    leaf.attitude.quaternion = pose.to_array();
    let rest = lying_height(cx, x, z, reach_down(&body, pose));
    let above = (position[1] - rest) * cx.scene.tilt_kept;
    let y = if above > SUNK_M { rest + above } else { rest };
    let slides = !is_blocked && (left.x != 0.0 || left.z != 0.0);
    leaf.place.position = [x, y, z];
    leaf.drift.velocity = if slides { [left.x, 0.0, left.z] } else { [0.0; 3] };
    leaf.drift.phase = if slides { 0 } else { ground_steps(leaf.drift.phase) + 1 };
    if leaf.drift.phase >= cx.scene.settle_steps && cx.scene.has_living_litter() {
        leaf_lie_down(cx, leaf, slope, own, words);
    }
}

/// Lays a leaf that has come to rest into the litter or on the water, if it has stopped where litter may lie: its volume waits to be added.
#[inline(always)]
pub fn leaf_lie_down(cx: &Context<'_>, leaf: &mut LeafMut<'_>, slope: Slope, friction: f32, words: [u32; 4]) {
    let [x, y, z] = leaf.place.position;
    if !litter_cell(cx, x, z).bears {
        return;
    }
    let raise = own_raise(cx, words);
    let species = leaf_species(leaf.place.bits);
    leaf.schedule.size = with_asymmetry(leaf.schedule.size, random_asymmetry(cx, leaf.identity.id));
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    let reach = reach_down(&body, leaf.attitude.quaternion.into());
    let at_rest = leaf_at_rest(cx, body, leaf.attitude.quaternion.into(), slope, friction, raise);
    let volume = lying_units(cx, leaf.place.bits, leaf.schedule.size, litter_height(cx, x, z));
    leaf.place.position = [x, y.max(lying_height(cx, x, z, reach)), z];
    leaf.place.bits = with_litter_change(place_bits(STATE_RESTING, 0, LYING, species, volume), CHANGE_ADDED);
    leaf.drift.phase = wake_speed_word(least_wake_square(cx, &at_rest));
    leaf.schedule.rate = lying_support_word(reach);
    leaf.schedule.heading = lying_word(friction, raise);
    if floats_at(cx, x, z) {
        leaf.place.position[1] = ground_bare(cx, x, z) + (cx.scene.rest_height_m + reach);
        leaf_set_afloat(cx, leaf, words);
    }
}

/// Volume that a leaf adds to litter of some height, in units of height over a cell; none to the highest.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most half a word; as in WGSL"
)]
#[inline(always)]
pub fn lying_units(cx: &Context<'_>, bits: u32, size: u32, depth: f32) -> u32 {
    let [_, _, _, nominal] = body_row(cx, bits, BODY_LITTER_ROW);
    let ratio = size_ratio(size);
    if depth < LITTER_HIGHEST_M { ((nominal * ratio) * ratio).min(HALF_MASK as f32) as u32 } else { 0 }
}
