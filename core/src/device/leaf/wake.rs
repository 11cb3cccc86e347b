// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/wake.wgsl
//!
//! Leaves in the litter wake by their own forces, in the wind at their own edge, under what lies on them.

use super::afloat::leaf_float;
use super::air::AIR_UNIT_SHIFT;
use super::at_rest::{leaf_at_rest, raising_axis, wind_moves};
use super::record::{
    CHANGE_REMOVED, CHANGE_WOKEN, body_spin_words, is_afloat, is_covered, is_held, is_on_ground, is_sunk,
    lies_still, lying_friction, lying_raise, lying_support, wake_speed_squared, with_cover,
    with_litter_change,
};
use super::strike::solid_footing;
use crate::arith::lane::{Mask, Real};
use crate::arith::math::reciprocal;
use crate::arith::quaternion::{Quat, quat_rotate_back};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::context::Context;
use crate::device::flight::body::{body_of, body_row};
use crate::device::terrain::ground::{ground_bare, ground_is_water, ground_rest, ground_slope, lying_over};
use crate::device::wind::pile_shadow::wind_behind_piles;
use crate::device::wind::sample::wind_at;
use crate::flight::block::BODY_LITTER_ROW;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Steps from one sample of the wind at a lying leaf to the next, where it blows.
    pub const WAKE_INTERVAL: u32 = 8;
    /// Steps after which it is seen what lies on and beneath a leaf; a multiple of the other.
    pub const COVER_INTERVAL: u32 = 64;
    /// The same where no wind blows: leaves sink only where others are recycled.
    pub const CALM_INTERVAL: u32 = 256;
    /// Layers above a leaf from which on no wind reaches it.
    pub const COVERED_LAYERS: f32 = 2.0;
    /// Spin in rad/s with which the wind turns a leaf up that it takes: by 20 degrees in a tenth of a second.
    pub const RAISING_RAD_S: f32 = 3.5;
    /// Layers of litter by which a leaf may lie above it before it sinks.
    pub const LOOSE_LAYERS: f32 = 2.0;
}

/// Returns true if a slot's unit has its turn in this step, of as many turns.
#[inline(always)]
fn unit_has_turn(cx: &Context<'_>, slot: u32, interval_steps: u32) -> bool {
    ((slot >> AIR_UNIT_SHIFT).wrapping_add(cx.step.index) & (interval_steps - 1)) == 0
}

/// Returns true if the lying leaves in a slot's unit sample the wind in this step.
#[inline(always)]
pub fn wake_is_due(cx: &Context<'_>, slot: u32) -> bool {
    unit_has_turn(cx, slot, cx.scene.litter.wake_steps)
}

/// Returns true if it is seen in this step what lies on and beneath the leaves in a slot's unit.
#[inline(always)]
pub fn cover_is_due(cx: &Context<'_>, slot: u32) -> bool {
    unit_has_turn(cx, slot, cx.scene.litter.cover_steps)
}

/// Layers of litter that a height is, of leaves like one with these bits.
#[inline(always)]
pub fn layers_above<R: Real>(cx: &Context<'_>, bits: R::Word, height: R) -> R {
    let [_, _, layer, _] = body_row(cx, bits, BODY_LITTER_ROW);
    height * reciprocal(layer)
}

/// Litter above and beneath leaves that lie in it.
#[derive(Clone, Copy, Debug)]
pub struct Cover<M = bool> {
    /// True of leaves that have lost what they lay on.
    pub is_loose: M,
    /// True of leaves that no wind reaches.
    pub is_covered: M,
}

/// Cover of leaves at a place, which reach down so far.
#[inline(always)]
pub fn cover_of<R: Real>(cx: &Context<'_>, bits: R::Word, place: Vec3<R>, reach: R) -> Cover<R::Mask> {
    let rest = ground_rest(cx, place.x, place.z);
    let floor = lying_over(cx, place.x, place.z, reach, rest);
    let beneath = layers_above(cx, bits, place.y - floor);
    let above = layers_above(cx, bits, rest - place.y);
    let on_ground = is_on_ground(bits);
    let mut is_loose = on_ground & beneath.all(LOOSE_LAYERS).less_than(beneath);
    let afloat = is_afloat(bits);
    if afloat.any() {
        // Water whose level has been set elsewhere.
        let above = place.y - (ground_bare(cx, place.x, place.z) + cx.scene.rest_height_m);
        let is_there = !above.less_than(above.all(0.0)) & !reach.less_than(above);
        is_loose = is_loose | (afloat & !(is_there & ground_is_water(cx, place.x, place.z)));
    }
    Cover { is_loose, is_covered: is_sunk(bits) | (on_ground & above.all(COVERED_LAYERS).less_than(above)) }
}

/// Marks a leaf in the litter that others cover. Returns true if it has lost what it lay on, and leaves.
#[inline(always)]
pub fn leaf_check_cover(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let bits = leaf.place.bits;
    if !lies_still(bits) {
        return false;
    }
    let Cover { is_loose, is_covered } =
        cover_of(cx, bits, leaf.place.position.into(), lying_support(leaf.schedule.rate));
    leaf.place.bits = with_cover(bits, is_covered);
    if is_loose {
        leaf.place.bits = with_litter_change(bits, CHANGE_REMOVED);
    }
    is_loose
}

/// Wind at leaves in the litter.
#[derive(Clone, Copy, Debug)]
pub struct LyingWind<R: Real = f32> {
    /// Velocity in m/s.
    pub wind: Vec3<R>,
    /// Layers above the leaves but for their own.
    pub cover: R,
    /// True where it may take them: in the direction that is the best for it, it would.
    pub may_wake: R::Mask,
}

/// Wind at leaves at a place, which reach down so far and wake at such a squared speed with nothing on them.
#[inline(always)]
pub fn lying_wind<R: Real>(
    cx: &Context<'_>,
    bits: R::Word,
    place: Vec3<R>,
    reach: R,
    wake_square: R,
) -> LyingWind<R> {
    let rest = is_held(bits).select_real(place.y - reach, ground_rest(cx, place.x, place.z));
    let cover = (layers_above(cx, bits, rest - place.y) - reach.all(1.0)).max(reach.all(0.0));
    let wind = wind_at(cx, Vec3::new(place.x, rest + reach, place.z));
    let may_wake = !vec3_dot(wind, wind).less_than(wake_square * (cover + 1.0));
    LyingWind { wind, cover, may_wake }
}

/// Lets the wind at a leaf in the litter decide if it stays; a leaf afloat drifts. Returns true if the wind takes it or sets it in motion.
#[inline(always)]
pub fn leaf_wake(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let bits = leaf.place.bits;
    if !lies_still(bits) || is_covered(bits) {
        return false;
    }
    let [x, _, z] = leaf.place.position;
    let reach = lying_support(leaf.schedule.rate);
    let wake_square = wake_speed_squared(leaf.drift.phase);
    let LyingWind { wind, cover, may_wake } =
        lying_wind(cx, bits, leaf.place.position.into(), reach, wake_square);
    if !may_wake {
        return false;
    }
    if is_afloat(bits) {
        return leaf_float(cx, leaf, wind);
    }
    let body = body_of(cx, bits, leaf.schedule.size);
    let pose = Quat::from(leaf.attitude.quaternion);
    let (slope, wind) = if is_held(bits) {
        (solid_footing(cx, &body, pose, leaf.place.position.into()).slope, wind)
    } else {
        (ground_slope(cx, x, z), wind_behind_piles(cx, x, z, wind))
    };
    let heading = leaf.schedule.heading;
    let mut at_rest = leaf_at_rest(cx, body, pose, slope, lying_friction(heading), lying_raise(heading));
    at_rest.pressing_m_s2 += cx.scene.gravity_m_s2 * cover;
    if !wind_moves(cx, &at_rest, wind, 1.0) {
        return false;
    }
    leaf.place.bits = with_litter_change(bits, CHANGE_WOKEN);
    // The edge that stands up against the wind leads: nothing else is kicked.
    let spin = quat_rotate_back(pose, raising_axis(&at_rest, wind) * RAISING_RAD_S);
    [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(spin);
    true
}
