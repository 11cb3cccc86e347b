// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/inward.wgsl
//!
//! Inward pass of the articulated-body algorithm: the response of a joint, and the inertia that its parent feels through it.

use super::{
    ArticulatedInertia, Body, Constants, Joint, JointResponse, STOP_ANGLE, STOP_DAMPING, STOP_STIFFNESS,
    Spring, VelocityProducts,
};
use crate::arith::lane::{Mask, Real};
use crate::arith::math::inverse_sqrt;
use crate::arith::matrix::{
    mat3_add, mat3_cross_from_left, mat3_cross_from_right, mat3_product, mat3_product_symmetric, mat3_times,
    mat3_transposed_product_symmetric, mat3_transposed_times, mat3_twice_symmetric, mat3_upper, sym3_add,
    sym3_axial, sym3_inverse, sym3_minus, sym3_rows, sym3_times,
};
use crate::arith::quaternion::{quat_rotate, turn_of_quat};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot, vec3_select};
use crate::context::Context;

/// Velocity-product accelerations of the joint between `parent` and `body`.
#[inline(always)]
pub fn velocity_products<R: Real>(body: &Body<R>, parent: &Body<R>) -> VelocityProducts<R> {
    let arm = body.base - parent.base;
    VelocityProducts {
        arm,
        angular: vec3_cross(parent.spin, body.spin - parent.spin),
        centripetal: vec3_cross(parent.spin, vec3_cross(parent.spin, arm)),
    }
}

/// Sum of two articulated inertias about the same joint.
#[inline(always)]
pub fn articulated_add<R: Real>(
    a: &ArticulatedInertia<R>,
    b: &ArticulatedInertia<R>,
) -> ArticulatedInertia<R> {
    ArticulatedInertia {
        rotation: sym3_add(a.rotation, b.rotation),
        coupling: mat3_add(a.coupling, b.coupling),
        mass: sym3_add(a.mass, b.mass),
        moment: a.moment + b.moment,
        force: a.force + b.force,
    }
}

/// Spring and damper of a joint; `carried` is the trace in kg m² of the moments of inertia beyond it.
#[inline(always)]
pub fn joint_spring<R: Real>(
    cx: &Context<'_>,
    constants: &Constants<R>,
    joint: &Joint<R>,
    body: &Body<R>,
    carried: R,
) -> Spring<R> {
    let bending = constants.bending;
    let ahead = bending.all(cx.scene.sway.ahead_s);
    let damping = constants.damping + ahead;
    let turn = turn_of_quat(joint.turn);
    let spring = turn + joint.rate * damping;
    let mut torque = Vec3::new(
        constants.preload.x - bending * spring.x,
        constants.preload.y - constants.twisting * spring.y,
        constants.preload.z - bending * spring.z,
    );
    let implicit = ahead * damping;
    let mut along = constants.twisting * implicit;
    let mut across = bending * implicit;
    // The stop is implicit too, so that segments beyond the joint feel it.
    let squared = vec3_dot(turn, turn);
    let beyond = bending.all(STOP_ANGLE * STOP_ANGLE).less_than(squared);
    if beyond.any() {
        let stiffness = carried * STOP_STIFFNESS;
        let share = bending.all(1.0) - inverse_sqrt(squared.max(bending.all(TINY_SQUARED))) * STOP_ANGLE;
        let stop = turn * share + joint.rate * (ahead + STOP_DAMPING);
        torque = vec3_select(beyond, torque - stop * stiffness, torque);
        let stopped = stiffness * (ahead * (ahead + STOP_DAMPING));
        along = beyond.select_real(along + stopped, along);
        across = beyond.select_real(across + stopped, across);
    }
    Spring { torque: quat_rotate(body.pose, torque), along, across }
}

/// Response of the joint of `whole`, a segment with everything that grows from it, and the articulated inertia and bias
/// force apparent to the parent through the joint, still about the segment's own joint.
#[inline(always)]
pub fn joint_response<R: Real>(
    spring: &Spring<R>,
    whole: &ArticulatedInertia<R>,
    axis: Vec3<R>,
    products: &VelocityProducts<R>,
) -> (JointResponse<R>, ArticulatedInertia<R>) {
    let torque = spring.torque;
    let spring = sym3_axial(axis, spring.along, spring.across);
    let inverse = sym3_inverse(sym3_add(whole.rotation, spring));
    let share = mat3_product(sym3_rows(spring), sym3_rows(inverse));
    let pull = torque - whole.moment;
    let lever = mat3_product(sym3_rows(inverse), whole.coupling);

    let rotation = mat3_product_symmetric(share, sym3_rows(whole.rotation));
    let coupling = mat3_product(share, whole.coupling);
    let mass = sym3_minus(whole.mass, mat3_transposed_product_symmetric(whole.coupling, lever));

    let VelocityProducts { angular, centripetal, .. } = *products;
    let moment = (torque - mat3_times(share, pull))
        + (sym3_times(rotation, angular) + mat3_times(coupling, centripetal));
    let force = (whole.force + mat3_transposed_times(lever, pull))
        + (mat3_transposed_times(coupling, angular) + sym3_times(mass, centripetal));
    (
        JointResponse { free: sym3_times(inverse, pull), spring: share, lever, products: *products },
        ArticulatedInertia { rotation, coupling, mass, moment, force },
    )
}

/// Articulated inertia about a point that lies `arm` before its own.
#[inline(always)]
pub fn articulated_shift<R: Real>(body: &ArticulatedInertia<R>, arm: Vec3<R>) -> ArticulatedInertia<R> {
    let carried = mat3_cross_from_left(arm, sym3_rows(body.mass));
    let turned = mat3_twice_symmetric(mat3_cross_from_right(body.coupling, arm));
    let swung = mat3_upper(mat3_cross_from_right(carried, arm));
    ArticulatedInertia {
        rotation: sym3_add(body.rotation, sym3_add(turned, swung)),
        coupling: mat3_add(body.coupling, carried),
        mass: body.mass,
        moment: body.moment + vec3_cross(arm, body.force),
        force: body.force,
    }
}
