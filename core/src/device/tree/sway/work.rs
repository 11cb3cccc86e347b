// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/work.wgsl
//!
//! Packing of the results of a pass into the rows of a segment ([`Work`]): vectors, each with a number behind it.

use super::composite::Composite;
use super::outward::Acceleration;
use super::{ArticulatedInertia, JointResponse, TwigResponse, VelocityProducts};
use crate::arith::{Mat3, Sym3, Vec3};
use crate::tree::forest::first_three;
use crate::tree::record::{WORK_RESPONSE, Work};

/// A vector and a fourth number.
#[inline(always)]
pub(super) fn four(v: Vec3, w: f32) -> [f32; 4] {
    [v.x, v.y, v.z, w]
}

/// Writes the inertia that a segment passes on to its parent.
#[inline(always)]
pub fn store_articulated(work: &mut Work, body: &ArticulatedInertia) {
    work[0] = four(body.rotation.diagonal, body.moment.x);
    work[1] = four(body.rotation.off, body.moment.y);
    work[2] = four(body.coupling.x, body.moment.z);
    work[3] = four(body.coupling.y, body.force.x);
    work[4] = four(body.coupling.z, body.force.y);
    work[5] = four(body.mass.diagonal, body.force.z);
    work[6] = four(body.mass.off, 0.0);
}

/// Reads the inertia that a segment passes on to its parent.
#[inline(always)]
pub fn load_articulated(work: &Work) -> ArticulatedInertia {
    ArticulatedInertia {
        rotation: Sym3 { diagonal: first_three(work[0]), off: first_three(work[1]) },
        coupling: Mat3 { x: first_three(work[2]), y: first_three(work[3]), z: first_three(work[4]) },
        mass: Sym3 { diagonal: first_three(work[5]), off: first_three(work[6]) },
        moment: Vec3::new(work[0][3], work[1][3], work[2][3]),
        force: Vec3::new(work[3][3], work[4][3], work[5][3]),
    }
}

/// Writes the response of a limb's joint.
#[inline(always)]
pub fn store_response(work: &mut Work, response: &JointResponse) {
    let rows = &mut work[WORK_RESPONSE as usize..];
    let VelocityProducts { arm, angular, centripetal } = response.products;
    rows[0] = four(response.free, angular.x);
    rows[1] = four(response.spring.x, angular.y);
    rows[2] = four(response.spring.y, angular.z);
    rows[3] = four(response.spring.z, centripetal.x);
    rows[4] = four(response.lever.x, centripetal.y);
    rows[5] = four(response.lever.y, centripetal.z);
    rows[6] = four(response.lever.z, 0.0);
    rows[7] = four(arm, 0.0);
}

/// Reads the response of a limb's joint.
#[inline(always)]
pub fn load_response(work: &Work) -> JointResponse {
    let rows = &work[WORK_RESPONSE as usize..];
    JointResponse {
        free: first_three(rows[0]),
        spring: Mat3 { x: first_three(rows[1]), y: first_three(rows[2]), z: first_three(rows[3]) },
        lever: Mat3 { x: first_three(rows[4]), y: first_three(rows[5]), z: first_three(rows[6]) },
        products: VelocityProducts {
            arm: first_three(rows[7]),
            angular: Vec3::new(rows[0][3], rows[1][3], rows[2][3]),
            centripetal: Vec3::new(rows[3][3], rows[4][3], rows[5][3]),
        },
    }
}

/// Writes the response of a twig's joint.
#[inline(always)]
pub fn store_twig_response(work: &mut Work, response: &TwigResponse) {
    let rows = &mut work[WORK_RESPONSE as usize..];
    rows[0] = four(response.free, response.spring_along);
    rows[1] = four(response.products.arm, response.spring_across);
    rows[2] = four(response.products.angular, response.lever);
    rows[3] = four(response.products.centripetal, 0.0);
}

/// Reads the response of a twig's joint.
#[inline(always)]
pub fn load_twig_response(work: &Work) -> TwigResponse {
    let rows = &work[WORK_RESPONSE as usize..];
    TwigResponse {
        free: first_three(rows[0]),
        spring_along: rows[0][3],
        spring_across: rows[1][3],
        lever: rows[2][3],
        products: VelocityProducts {
            arm: first_three(rows[1]),
            angular: first_three(rows[2]),
            centripetal: first_three(rows[3]),
        },
    }
}

/// Writes the acceleration of a limb, over the inertia that it has passed on.
#[inline(always)]
pub fn store_acceleration(work: &mut Work, acceleration: &Acceleration) {
    work[0] = four(acceleration.angular, 0.0);
    work[1] = four(acceleration.linear, 0.0);
}

/// Reads the acceleration of a limb.
#[inline(always)]
pub fn load_acceleration(work: &Work) -> Acceleration {
    Acceleration { angular: first_three(work[0]), linear: first_three(work[1]) }
}

/// Writes the composite body of a segment and everything that grows from it.
#[inline(always)]
pub fn store_composite(work: &mut Work, whole: &Composite) {
    work[0] = four(whole.inertia.diagonal, whole.mass);
    work[1] = four(whole.inertia.off, whole.drag);
    work[2] = four(whole.moment, whole.drag_inertia);
    work[3] = four(whole.torque, 0.0);
    work[4] = four(whole.force, 0.0);
    work[5] = four(whole.drag_moment, 0.0);
}

/// Reads the composite body of a segment and everything that grows from it.
#[inline(always)]
pub fn load_composite(work: &Work) -> Composite {
    Composite {
        inertia: Sym3 { diagonal: first_three(work[0]), off: first_three(work[1]) },
        moment: first_three(work[2]),
        mass: work[0][3],
        torque: first_three(work[3]),
        force: first_three(work[4]),
        drag: work[1][3],
        drag_moment: first_three(work[5]),
        drag_inertia: work[2][3],
    }
}
