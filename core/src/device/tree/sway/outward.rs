// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/outward.wgsl
//!
//! Outward pass of the articulated-body algorithm: the acceleration of a joint from its parent's, and its integration.

use super::{
    Body, Constants, IMPLICITNESS, JOINT_LIMIT, JOINT_LIMIT_COSINE, Joint, JointResponse, TURN_LIMIT,
    VelocityProducts,
};
use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::matrix::{mat3_times, mat3_transposed_times};
use crate::arith::quaternion::{
    Quat, quat_multiply, quat_of_turn, quat_renormalize, quat_rotate, quat_rotate_back,
};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot, vec3_select};
use crate::context::Context;

/// Accelerations of a segment: angular in rad/s², and of its joint in m/s².
#[derive(Clone, Copy, Debug)]
pub struct Acceleration<R = f32> {
    /// Angular acceleration.
    pub angular: Vec3<R>,
    /// Acceleration of the joint.
    pub linear: Vec3<R>,
}

/// Accelerations that a segment would have if its joint were rigid.
#[inline(always)]
pub fn carried_acceleration<R: Real>(
    products: &VelocityProducts<R>,
    parent: &Acceleration<R>,
) -> Acceleration<R> {
    Acceleration {
        angular: parent.angular + products.angular,
        linear: (parent.linear + vec3_cross(parent.angular, products.arm)) + products.centripetal,
    }
}

/// Accelerations of a segment from its parent's, and the joint's own part of the angular one.
#[inline(always)]
pub fn joint_acceleration<R: Real>(
    response: &JointResponse<R>,
    parent: &Acceleration<R>,
) -> (Acceleration<R>, Vec3<R>) {
    let carried = carried_acceleration(&response.products, parent);
    let own = ((response.free - carried.angular) + mat3_transposed_times(response.spring, carried.angular))
        - mat3_times(response.lever, carried.linear);
    (Acceleration { angular: carried.angular + own, linear: carried.linear }, own)
}

/// Vector clamped to a length of `limit`.
#[inline(always)]
pub fn shortened<R: Real>(v: Vec3<R>, limit: R) -> Vec3<R> {
    let squared = vec3_dot(v, v);
    let over = (limit * limit).less_than(squared);
    if !over.any() {
        return v;
    }
    let scale = limit * inverse_sqrt(squared.max(limit.all(TINY_SQUARED)));
    vec3_select(over, v * scale, v)
}

/// Joint after a step with the angular acceleration `own` in world axes.
#[inline(always)]
pub fn joint_step<R: Real>(cx: &Context<'_>, joint: &Joint<R>, body: &Body<R>, own: Vec3<R>) -> Joint<R> {
    let dt = cx.scene.sway.dt_s;
    let limit = own.x.all(TURN_LIMIT * cx.scene.sway.inv_dt_s);
    let gain = quat_rotate_back(body.pose, own) * own.x.all(dt);
    let rate = shortened(joint.rate + gain, limit);
    let on_the_way = shortened(joint.rate + gain * own.x.all(IMPLICITNESS), limit);
    let moved = quat_multiply(joint.turn, quat_of_turn(on_the_way * own.x.all(dt)));
    joint_stop(quat_renormalize(moved), rate)
}

/// Joint held at the largest angle that it may have.
#[inline(always)]
fn joint_stop<R: Real>(turn: Quat<R>, rate: Vec3<R>) -> Joint<R> {
    let axis = Vec3::new(turn.x, turn.y, turn.z);
    let squared = vec3_dot(axis, axis);
    let stopped = squared.all(JOINT_LIMIT * JOINT_LIMIT).less_than(squared);
    if !stopped.any() {
        return Joint { turn, rate };
    }
    let inverse = inverse_sqrt(squared.max(squared.all(TINY_SQUARED)));
    let held = vec3_select(stopped, axis * (inverse * JOINT_LIMIT), axis);
    let outward = (vec3_dot(rate, axis) * (inverse * inverse)).max(squared.all(0.0));
    Joint {
        turn: Quat::new(held.x, held.y, held.z, stopped.select_real(squared.all(JOINT_LIMIT_COSINE), turn.w)),
        rate: vec3_select(stopped, rate - axis * outward, rate),
    }
}

/// Joint of a rotation vector and rate, held within the range of the series for its quaternion.
#[inline(always)]
pub fn joint_held(cx: &Context<'_>, turn: Vec3, rate: Vec3) -> Joint {
    let squared = vec3_dot(turn, turn);
    let stopped = squared > TURN_LIMIT * TURN_LIMIT;
    let outward = (vec3_dot(rate, turn) * reciprocal(squared.max(TINY_SQUARED))).max(0.0);
    let kept = rate - turn * if stopped { outward } else { 0.0 };
    Joint {
        turn: quat_renormalize(quat_of_turn(shortened(turn, TURN_LIMIT))),
        rate: shortened(kept, TURN_LIMIT * cx.scene.sway.inv_dt_s),
    }
}

/// Pose and velocity of a segment from its joint and its parent (forward kinematics).
#[inline(always)]
pub fn segment_place<R: Real>(constants: &Constants<R>, joint: &Joint<R>, parent: &Body<R>) -> Body<R> {
    let pose = quat_multiply(quat_multiply(parent.pose, constants.rest), joint.turn);
    let arm = quat_rotate(parent.pose, constants.offset);
    Body {
        base: parent.base + arm,
        pose,
        velocity: parent.velocity + vec3_cross(parent.spin, arm),
        spin: parent.spin + quat_rotate(pose, joint.rate),
    }
}
