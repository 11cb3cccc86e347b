// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/load.wgsl
//!
//! Load on a segment by itself: inertia, weight, gyroscopic force, and the drag of wood and leaves.
//!
//! # Source
//! Drag by the velocity relative to the air, and its fall as leaves turn aside: Vogel, "Drag and reconfiguration of broad
//! leaves in high winds" (1989). Across a branch only the wind's part across it counts.

use super::{ArticulatedInertia, Body, Constants, Load, THIRD};
use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::matrix::{mat3_cross, sym3_axial};
use crate::arith::quaternion::quat_axis_y;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::blocks::MOMENT_MIDDLE;
use crate::context::Context;
use crate::device::wind::sample::wind_at_moment;

/// Drag on a segment at its centre.
#[derive(Clone, Copy, Debug)]
pub struct Drag<R = f32> {
    /// Velocity of the air relative to the centre in m/s.
    pub wind: Vec3<R>,
    /// Component of it across the wood in m/s.
    pub across: Vec3<R>,
    /// Force per relative velocity across the wood in N s/m.
    pub wood: R,
    /// Force per relative velocity on the leaves in N s/m.
    pub leaves: R,
}

/// Drag on a segment with `leaf_count` leaves whose centre moves at `velocity` in air of velocity `air`.
#[inline(always)]
pub fn segment_drag<R: Real>(
    constants: &Constants<R>,
    axis: Vec3<R>,
    air: Vec3<R>,
    velocity: Vec3<R>,
    leaf_count: R,
) -> Drag<R> {
    let wind = air - velocity;
    // Not from squares, whose difference is all rounding in a wind along the wood.
    let across = wind - axis * vec3_dot(wind, axis);
    let tiny = leaf_count.all(TINY_SQUARED);
    let squared_across = vec3_dot(across, across).max(tiny);
    let speed_across = squared_across * inverse_sqrt(squared_across);
    let mut leaves = leaf_count.all(0.0);
    if leaves.less_than(leaf_count).any() {
        let squared = vec3_dot(wind, wind);
        let speed = squared * inverse_sqrt(squared.max(tiny));
        let yielding = reciprocal(speed * constants.leaf_yield + 1.0);
        leaves = ((constants.leaf_drag * leaf_count) * speed) * yielding;
    }
    Drag { wind, across, wood: constants.wood_drag * speed_across, leaves }
}

/// Returns true if limbs sample the air in this step, in which a new interval begins for them. It is the interval of falling leaves, in
/// steps that solve the joints.
#[inline(always)]
pub fn segment_air_is_sampled(cx: &Context<'_>) -> bool {
    let first = cx.scene.sway.interval_steps - 1;
    (cx.step.index.wrapping_sub(first) & (cx.scene.wind.interval_steps - 1)) == 0
}

/// Velocity of the air at the end of a segment in the middle of the interval that begins with the step, for the segment and for the twigs that grow there.
#[inline(always)]
pub fn segment_air<R: Real>(cx: &Context<'_>, body: &Body<R>, axis: Vec3<R>, length: R) -> Vec3<R> {
    wind_at_moment(cx, MOMENT_MIDDLE, body.base + axis * length)
}

/// Load on a segment with `leaf_count` leaves and so much snow, in air of velocity `air`.
#[inline(always)]
pub fn segment_load<R: Real>(
    cx: &Context<'_>,
    constants: &Constants<R>,
    body: &Body<R>,
    axis: Vec3<R>,
    air: Vec3<R>,
    leaf_count: R,
    snow_kg: R,
) -> Load<R> {
    let half = constants.length * 0.5;
    let middle = axis * half;
    let velocity = body.velocity + vec3_cross(body.spin, middle);
    let drag = segment_drag(constants, axis, air, velocity, leaf_count);
    let held = drag.wood + drag.leaves;
    let push = drag.across * drag.wood + drag.wind * drag.leaves;

    let leaves = constants.leaf_mass * leaf_count + snow_kg;
    let mass = constants.mass + leaves;
    let moment = constants.first_moment + leaves * half;
    let across = constants.inertia_across + leaves * ((constants.length * constants.length) * THIRD);
    let gravity = cx.scene.gravity_m_s2;
    // Implicit drag acts like a mass added at the centre.
    let dt = cx.scene.sway.dt_s;
    let added = held * dt;
    let heavy = across + added * (half * half);
    let bare = mass + added;

    let turning = vec3_dot(body.spin, axis);
    let gyration = body.spin * ((constants.inertia_along - across) * turning);
    let outward = body.spin * turning - axis * vec3_dot(body.spin, body.spin);
    // Torques about the joint are vector products with the axis, of all forces together.
    let levered = gyration + push * half;
    let moved = Vec3::new(levered.x, levered.y - moment * gravity, levered.z);
    let force = outward * moment - push;
    Load {
        rotation_along: constants.inertia_along,
        rotation_across: heavy,
        coupling: moment + added * half,
        mass_along: bare - drag.wood * dt,
        mass_across: bare,
        moment: vec3_cross(moved, axis),
        force: Vec3::new(force.x, force.y + mass * gravity, force.z),
    }
}

/// Trace of a load's moments of inertia in kg m².
#[inline(always)]
pub fn load_trace<R: Real>(load: &Load<R>) -> R {
    (load.rotation_along + load.rotation_across) + load.rotation_across
}

/// Load as an articulated inertia.
#[inline(always)]
pub fn segment_body<R: Real>(load: &Load<R>, axis: Vec3<R>) -> ArticulatedInertia<R> {
    ArticulatedInertia {
        rotation: sym3_axial(axis, load.rotation_along, load.rotation_across),
        coupling: mat3_cross(axis, load.coupling),
        mass: sym3_axial(axis, load.mass_along, load.mass_across),
        moment: load.moment,
        force: load.force,
    }
}

/// Direction of a segment.
#[inline(always)]
pub fn segment_axis<R: Real>(body: &Body<R>) -> Vec3<R> {
    quat_axis_y(body.pose)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arith::vector::vec3_cross;
    use crate::tree::record::SegmentConstants;

    proptest! {
        /// Wind that blows nearly along a branch drags at it with the little that comes across.
        #[test]
        fn drag_across_a_branch_is_right_in_a_wind_along_it(
            way in [-1.0f32..1.0, -1.0f32..1.0, 0.5f32..1.0],
            speed in 1.0f32..60.0,
            slant in 1e-3f32..1e-1,
        ) {
            let way = Vec3::from(way);
            let axis = way * inverse_sqrt(vec3_dot(way, way));
            let aside = vec3_cross(axis, Vec3::new(0.0, 1.0, 0.0));
            let air = (axis + aside * slant) * speed;
            let constants = Constants::from(&SegmentConstants { wood_drag: 1.0, ..bytemuck::Zeroable::zeroed() });
            let drag = segment_drag(&constants, axis, air, Vec3::ZERO, 0.0);
            let [a, w] = [axis, air].map(|v| v.to_array().map(f64::from));
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let across = (dot(w, w) - dot(w, a) * dot(w, a) / dot(a, a)).sqrt();
            let wood = f64::from(drag.wood);
            prop_assert!((wood - across).abs() <= 1e-6 * f64::from(speed), "{wood} for {across}");
        }
    }
}
