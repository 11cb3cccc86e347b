// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/fold.wgsl
//!
//! The pass towards the foot: what a segment hands to its parent, and how its joint will answer.

use super::{
    Answer, Articulated, Body, Constants, IMPLICITNESS, Joint, STOP_ANGLE, STOP_DAMPING, STOP_STIFFNESS,
};
use crate::context::Context;
use crate::kernel::lane::{Mask, Real};
use crate::kernel::math::inverse_sqrt;
use crate::kernel::matrix::{
    Mat3, Sym3, mat3_add, mat3_cross_from_left, mat3_cross_from_right, mat3_product, mat3_product_symmetric,
    mat3_times, mat3_transposed_product_symmetric, mat3_transposed_times, mat3_twice_symmetric, sym3_add,
    sym3_axial, sym3_inverse, sym3_minus, sym3_rows, sym3_times,
};
use crate::kernel::quaternion::{quat_rotate, turn_of_quat};
use crate::kernel::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};

/// Sum of two bodies about the same joint.
#[inline(always)]
pub fn articulated_add<R: Real>(a: &Articulated<R>, b: &Articulated<R>) -> Articulated<R> {
    Articulated {
        rotation: sym3_add(a.rotation, b.rotation),
        coupling: mat3_add(a.coupling, b.coupling),
        mass: sym3_add(a.mass, b.mass),
        moment: a.moment + b.moment,
        force: a.force + b.force,
    }
}

/// Torque of a joint's spring and damper in world axes, as it will be on the way through the step if the joint does not
/// accelerate, and the stiffness that the joint adds to the inertia it sees.
#[inline(always)]
pub fn joint_spring<R: Real>(
    cx: &Context<'_>,
    constants: &Constants<R>,
    joint: &Joint<R>,
    body: &Body<R>,
    axis: Vec3<R>,
    carried: Sym3<R>,
) -> (Vec3<R>, Sym3<R>) {
    let bending = constants.bending;
    let ahead = bending.all(cx.environment.time.0[0] * IMPLICITNESS);
    let turn = turn_of_quat(joint.turn);
    let spring = turn + joint.rate * (constants.damping + ahead);
    // The stop, sprung as well, so that what is beyond the joint feels it.
    let squared = vec3_dot(turn, turn);
    let beyond = bending.all(STOP_ANGLE * STOP_ANGLE).less_than(squared);
    let inertia = (carried.diagonal.x + carried.diagonal.y) + carried.diagonal.z;
    let stiffness = beyond.select_real(inertia * STOP_STIFFNESS, bending.all(0.0));
    let share = bending.all(1.0) - inverse_sqrt(squared.max(bending.all(TINY_SQUARED))) * STOP_ANGLE;
    let stop = turn * share + joint.rate * (ahead + STOP_DAMPING);
    let torque = Vec3::new(
        (constants.preload.x - bending * spring.x) - stiffness * stop.x,
        (constants.preload.y - constants.twisting * spring.y) - stiffness * stop.y,
        (constants.preload.z - bending * spring.z) - stiffness * stop.z,
    );
    let stopped = stiffness * (ahead * (ahead + STOP_DAMPING));
    (
        quat_rotate(body.pose, torque),
        sym3_axial(axis, constants.twisting_inertia + stopped, constants.bending_inertia + stopped),
    )
}

/// How the joint of `whole`, a segment with everything that it carries, answers, and what is left for the parent, still
/// about the segment's own joint.
#[inline(always)]
pub fn joint_answer<R: Real>(
    torque: Vec3<R>,
    spring: Sym3<R>,
    whole: &Articulated<R>,
    body: &Body<R>,
    parent: &Body<R>,
) -> (Answer<R>, Articulated<R>) {
    let inverse = sym3_inverse(sym3_add(whole.rotation, spring));
    let share = mat3_product(sym3_rows(spring), sym3_rows(inverse));
    let pull = torque - whole.moment;
    let lever = mat3_product(sym3_rows(inverse), whole.coupling);

    let rotation = mat3_product_symmetric(share, sym3_rows(whole.rotation));
    let coupling = mat3_product(share, whole.coupling);
    let mass = sym3_minus(whole.mass, mat3_transposed_product_symmetric(whole.coupling, lever));

    let arm = body.base - parent.base;
    let turning = vec3_cross(parent.spin, body.spin - parent.spin);
    let centripetal = vec3_cross(parent.spin, vec3_cross(parent.spin, arm));
    let moment = (torque - mat3_times(share, pull))
        + (sym3_times(rotation, turning) + mat3_times(coupling, centripetal));
    let force = (whole.force + mat3_transposed_times(lever, pull))
        + (mat3_transposed_times(coupling, turning) + sym3_times(mass, centripetal));
    (
        Answer { free: sym3_times(inverse, pull), spring: share, lever, arm, turning, centripetal },
        Articulated { rotation, coupling, mass, moment, force },
    )
}

/// The same body about a point that lies `arm` before its own.
#[inline(always)]
pub fn articulated_shift<R: Real>(body: &Articulated<R>, arm: Vec3<R>) -> Articulated<R> {
    let mass = sym3_rows(body.mass);
    let carried = mat3_cross_from_left(arm, mass);
    let turned = mat3_cross_from_right(body.coupling, arm);
    let swung = mat3_cross_from_right(carried, arm);
    let half = arm.x.all(0.5);
    let both =
        Mat3 { x: turned.x + swung.x * half, y: turned.y + swung.y * half, z: turned.z + swung.z * half };
    Articulated {
        rotation: sym3_add(body.rotation, mat3_twice_symmetric(both)),
        coupling: mat3_add(body.coupling, carried),
        mass: body.mass,
        moment: body.moment + vec3_cross(arm, body.force),
        force: body.force,
    }
}
