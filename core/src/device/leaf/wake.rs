// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/wake.wgsl
//!
//! Leaves in the litter wake by their own forces, in the wind at their own edge, under what lies on them.

use super::air::AIR_UNIT_SHIFT;
use super::at_rest::{leaf_at_rest, raising_axis, wind_moves};
use super::record::{
    CHANGE_NONE, CHANGE_REMOVED, CHANGE_WOKEN, body_spin_words, lies, litter_change, lying_friction,
    lying_raise, lying_support, wake_speed_squared, with_litter_change,
};
use crate::arith::math::reciprocal;
use crate::arith::quaternion::{Quat, quat_rotate_back};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::context::Context;
use crate::device::flight::body::{body_of, body_row};
use crate::device::terrain::ground::{ground_rest, ground_slope, lying_height};
use crate::device::wind::sample::wind_at;
use crate::flight::block::BODY_LITTER_ROW;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Steps from one sample of the wind at a lying leaf to the next.
    pub const WAKE_INTERVAL: u32 = 8;
    /// Spin in rad/s with which the wind turns a leaf up that it takes: by 20 degrees in a tenth of a second.
    pub const RAISING_RAD_S: f32 = 3.5;
    /// Layers of litter by which a leaf may lie above it before it sinks.
    pub const LOOSE_LAYERS: f32 = 2.0;
}

/// Returns true if the lying leaves in a slot's unit sample the wind in this step.
#[inline(always)]
pub fn wake_is_due(cx: &Context<'_>, slot: u32) -> bool {
    ((slot >> AIR_UNIT_SHIFT).wrapping_add(cx.step.index) & (WAKE_INTERVAL - 1)) == 0
}

/// Finds out if a leaf in the litter stays: the wind may take it, or it has lost what it lay on. Returns true if it leaves.
#[inline(always)]
pub fn leaf_wake(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let bits = leaf.place.bits;
    if !lies(bits) || litter_change(bits) != CHANGE_NONE {
        return false;
    }
    let [x, y, z] = leaf.place.position;
    let reach = lying_support(leaf.schedule.rate);
    let rest = ground_rest(cx, x, z);
    let [_, _, layer, _] = body_row(cx, bits, BODY_LITTER_ROW);
    if y > rest + LOOSE_LAYERS * layer && y > lying_height(cx, x, z, reach) + LOOSE_LAYERS * layer {
        leaf.place.bits = with_litter_change(bits, CHANGE_REMOVED);
        return true;
    }
    let cover = ((rest - y) * reciprocal(layer) - 1.0).max(0.0);
    let wind = wind_at(cx, Vec3::new(x, rest + reach, z));
    if vec3_dot(wind, wind) < wake_speed_squared(leaf.drift.phase) * (1.0 + cover) {
        return false;
    }
    let slope = ground_slope(cx, x, z);
    let body = body_of(cx, bits, leaf.schedule.size);
    let pose = Quat::from(leaf.attitude.quaternion);
    let heading = leaf.schedule.heading;
    let mut at_rest = leaf_at_rest(cx, body, pose, slope, lying_friction(heading), lying_raise(heading));
    at_rest.pressing_m_s2 = at_rest.pressing_m_s2 + cx.scene.gravity_m_s2 * cover;
    if !wind_moves(cx, &at_rest, wind, 1.0) {
        return false;
    }
    leaf.place.bits = with_litter_change(bits, CHANGE_WOKEN);
    // The edge that stands up against the wind leads: nothing else is kicked.
    let spin = quat_rotate_back(pose, raising_axis(&at_rest, wind) * RAISING_RAD_S);
    [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(spin);
    true
}
