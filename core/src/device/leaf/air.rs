// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/air.wgsl
//!
//! The air that a falling leaf meets: the wind where the leaf is in the middle of an interval of a few steps, sampled once for the
//! interval. To second order it stands for the interval's mean.

use super::fall::response_of;
use super::record::{STATE_FALLING, flies, leaf_state};
use crate::arith::lane::Real;
use crate::arith::vector::Vec3;
use crate::blocks::MOMENT_MIDDLE;
use crate::context::Context;
use crate::device::wind::packed::wind_pack;
use crate::device::wind::sample::wind_at_moment;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Binary logarithm of the slots that sample in the same step: all lanes of a wave go the same way.
    pub const AIR_UNIT_SHIFT: u32 = 6;
}

/// Returns true if the leaf in a slot samples the wind in this step, in which a new interval begins for it. Units of slots take
/// turns, so that every step costs the same, but not in a world that repeats: there a leaf goes on in another slot.
#[inline(always)]
pub fn air_is_sampled(cx: &Context<'_>, slot: u32) -> bool {
    let turn = if cx.scene.ids_per_life == 0 { 0 } else { slot >> AIR_UNIT_SHIFT };
    (turn.wrapping_add(cx.step.index) & (cx.scene.wind.interval_steps - 1)) == 0
}

/// The air of the interval that begins with this step, packed. Of a leaf's own motion the steady descent g tau counts.
#[inline(always)]
pub fn air_sample<R: Real>(
    cx: &Context<'_>,
    position: Vec3<R>,
    drift: Vec3<R>,
    time_constant_s: R,
) -> [R::Word; 2] {
    let descent = time_constant_s * cx.scene.gravity_m_s2;
    let velocity = Vec3::new(drift.x, drift.y - descent, drift.z);
    let way = velocity * descent.all(cx.scene.wind.half_interval_s);
    wind_pack(wind_at_moment(cx, MOMENT_MIDDLE, position + way))
}

/// Samples the air for a leaf, if it falls.
#[inline(always)]
pub fn leaf_sample_air(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let bits = leaf.place.bits;
    if leaf_state(bits) == STATE_FALLING && !flies(bits) {
        let (position, drift) = (leaf.place.position.into(), leaf.drift.velocity.into());
        *leaf.air = air_sample(cx, position, drift, response_of(cx, bits).time_constant_s);
    }
}
