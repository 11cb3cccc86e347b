// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/at_rest.wgsl
//!
//! The wind that moves a leaf at rest: the leaf slides, tips over its lee edge, or lifts. All these forces grow with the square of the
//! wind's speed, so for a direction of the wind there is one speed at which the first of the three happens.
//!
//! A fallen leaf is curled: whichever way the wind comes, some edge stands up against it. So the forces are those of its pose turned up
//! against the wind by an angle of its own.

use crate::arith::math::{inverse_sqrt, reciprocal, sin_cos_turns};
use crate::arith::quaternion::{Quat, quat_multiply, quat_rotate, quat_rotate_back};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::context::Context;
use crate::device::flight::body::LeafBody;
use crate::device::flight::contact::support;
use crate::device::flight::rates::still_load;
use crate::device::terrain::ground::{DROP_DIRECTIONS, Slope, drop_direction};

crate::shared_constants! {
    /// Square in m²/s² of a speed that no wind reaches.
    pub const NEVER_WAKES: f32 = 1e6;
    /// Square in m²/s² of the least speed that counts: a word of it is far above the steps of coming to rest.
    pub const LEAST_WAKES: f32 = 1e-6;
    /// Least force per squared speed that counts, in 1/m.
    pub const LEAST_FORCE: f32 = 1e-6;
    /// Square of the share of its waking speed below which the wind lets a leaf come to rest.
    pub const REST_SHARE_SQUARED: f32 = 0.81;
}

/// A leaf at rest on a slope.
#[derive(Clone, Copy, Debug)]
pub struct LeafAtRest {
    /// The leaf as a body.
    pub body: LeafBody,
    /// Its orientation.
    pub pose: Quat,
    /// Normal of the surface beneath.
    pub normal: Vec3,
    /// Friction coefficient.
    pub friction: f32,
    /// Angle in 2^-16 turns by which its edges stand up.
    pub raise: u32,
    /// Acceleration in m/s² with which its own weight, suction and what lies on it press it down.
    pub pressing_m_s2: f32,
}

/// A leaf at rest with nothing on it.
#[inline(always)]
pub fn leaf_at_rest(
    cx: &Context<'_>,
    body: LeafBody,
    pose: Quat,
    slope: Slope,
    friction: f32,
    raise: u32,
) -> LeafAtRest {
    let up = inverse_sqrt(slope.gain);
    let normal = Vec3::new(-(slope.x * up), up, -(slope.z * up));
    let suction = cx.scene.litter.adhesion_m2_s2 * body.air_per_m;
    LeafAtRest { body, pose, normal, friction, raise, pressing_m_s2: cx.scene.gravity_m_s2 + suction }
}

/// Squared speed at which a force per squared speed overcomes what holds.
#[inline(always)]
fn square_to_overcome(holding: f32, force: f32) -> f32 {
    if force > LEAST_FORCE { holding.max(0.0) * reciprocal(force) } else { NEVER_WAKES }
}

/// Unit vector about which wind in a direction turns a leaf up.
#[inline(always)]
pub fn raising_axis(leaf: &LeafAtRest, direction: Vec3) -> Vec3 {
    let axis = vec3_cross(leaf.normal, direction);
    axis * inverse_sqrt(vec3_dot(axis, axis).max(TINY_SQUARED))
}

/// Square in m²/s² of the speed at which wind in a direction, a unit vector, moves a leaf.
#[inline(always)]
pub fn wake_square(cx: &Context<'_>, leaf: &LeafAtRest, direction: Vec3) -> f32 {
    let axis = raising_axis(leaf, direction);
    let (sine, cosine) = sin_cos_turns((leaf.raise << 16) >> 1);
    let pose = quat_multiply(Quat::new(axis.x * sine, axis.y * sine, axis.z * sine, cosine), leaf.pose);
    let flow = quat_rotate_back(pose, direction * -1.0);
    let (inner_force, inner_torque) = still_load(&leaf.body, flow);
    let force = quat_rotate(pose, inner_force);
    let torque = quat_rotate(pose, inner_torque);
    let lift = vec3_dot(force, leaf.normal);
    let level = force - leaf.normal * lift;
    let squared = vec3_dot(level, level).max(TINY_SQUARED);
    let inverse = inverse_sqrt(squared);
    let way = level * inverse;
    let drag = squared * inverse;
    let holding = leaf.pressing_m_s2 * leaf.normal.y;
    let (radius, _) = support(&leaf.body, quat_rotate_back(pose, way));
    let lever =
        vec3_dot(torque, vec3_cross(leaf.normal, way)) * reciprocal(radius * leaf.body.inv_size_ratio);
    let downhill = cx.scene.gravity_m_s2 * way.y;
    let lifts = square_to_overcome(holding, lift);
    let tips = square_to_overcome(holding, lift + lever);
    let slides = square_to_overcome(leaf.friction * holding + downhill, drag + leaf.friction * lift);
    lifts.min(tips).min(slides)
}

/// The least of these squares over directions of level wind.
#[inline(always)]
pub fn least_wake_square(cx: &Context<'_>, leaf: &LeafAtRest) -> f32 {
    let mut least = NEVER_WAKES;
    for number in 0..DROP_DIRECTIONS {
        let [x, z] = drop_direction(number);
        least = wake_square(cx, leaf, Vec3::new(x, 0.0, z)).min(least);
    }
    least.max(LEAST_WAKES)
}

/// Returns true if the wind moves a leaf at rest: its speed exceeds a share, given squared, of that at which it does.
#[inline(always)]
pub fn wind_moves(cx: &Context<'_>, leaf: &LeafAtRest, wind: Vec3, share_squared: f32) -> bool {
    let squared = vec3_dot(wind, wind).max(TINY_SQUARED);
    let direction = wind * inverse_sqrt(squared);
    wake_square(cx, leaf, direction) * share_squared < squared
}

/// Returns true if a leaf slides down, without any wind: the slope exceeds its friction.
#[inline(always)]
pub fn slides_down(leaf: &LeafAtRest) -> bool {
    let up_squared = leaf.normal.y * leaf.normal.y;
    (leaf.friction * leaf.friction) * up_squared < 1.0 - up_squared
}
