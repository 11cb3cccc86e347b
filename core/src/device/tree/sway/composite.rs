// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/composite.wgsl
//!
//! Composite rigid body of a segment and everything that grows from it, for the schemes that step joints one by one.
//!
//! # Source
//! Pass 1 of Quigley et al., "Real-time interactive tree animation" (2018): composite mass, centre, inertia, force and
//! torque. About each joint's own point and in world axes no centre is needed.
//!
//! Drag acts on a joint as if only that joint moved: the wind pushes with its own speed, and the joint's rate is damped
//! by the drag of all that swings with it. If every joint responded to the whole velocity of its twigs, a chain of them
//! would count it several times and become unstable.

use super::load::segment_drag;
use super::{Body, Constants, THIRD};
use crate::arith::matrix::{Sym3, sym3_add, sym3_axial};
use crate::arith::vector::{Vec3, vec3_cross, vec3_dot};
use crate::context::Context;

/// Composite rigid body about a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composite {
    /// Moment of inertia in kg m².
    pub inertia: Sym3,
    /// First moment in kg m.
    pub moment: Vec3,
    /// Mass in kg.
    pub mass: f32,
    /// Torque of weight and wind in N m.
    pub torque: Vec3,
    /// Force of weight and wind in N.
    pub force: Vec3,
    /// Drag force per speed, summed, in N s/m.
    pub drag: f32,
    /// Drag coefficient times distance from the joint, in N s.
    pub drag_moment: Vec3,
    /// Drag coefficient times squared distance, in N s m.
    pub drag_inertia: f32,
}

/// Rigid body of a segment by itself that carries `leaf_count` leaves and so much snow in moving air.
#[inline(always)]
pub fn segment_composite(
    cx: &Context<'_>,
    constants: &Constants,
    body: &Body,
    axis: Vec3,
    air: Vec3,
    leaf_count: f32,
    snow_kg: f32,
) -> Composite {
    let half = constants.length * 0.5;
    let middle = axis * half;
    let velocity = body.velocity + vec3_cross(body.spin, middle);
    let drag = segment_drag(constants, axis, air, velocity, leaf_count);
    let held = drag.wood + drag.leaves;
    let push = air * held - axis * (vec3_dot(air, axis) * drag.wood);

    let leaves = constants.leaf_mass * leaf_count + snow_kg;
    let mass = constants.mass + leaves;
    let moment = constants.first_moment + leaves * half;
    let across = constants.inertia_across + leaves * ((constants.length * constants.length) * THIRD);
    let weight = Vec3::new(0.0, -cx.scene.gravity_m_s2, 0.0);
    Composite {
        inertia: sym3_axial(axis, constants.inertia_along, across),
        moment: axis * moment,
        mass,
        torque: vec3_cross(middle, push) + vec3_cross(axis, weight) * moment,
        force: push + weight * mass,
        drag: held,
        drag_moment: middle * held,
        drag_inertia: held * (half * half),
    }
}

/// Sum of two bodies about the same joint.
#[inline(always)]
pub fn composite_add(a: &Composite, b: &Composite) -> Composite {
    Composite {
        inertia: sym3_add(a.inertia, b.inertia),
        moment: a.moment + b.moment,
        mass: a.mass + b.mass,
        torque: a.torque + b.torque,
        force: a.force + b.force,
        drag: a.drag + b.drag,
        drag_moment: a.drag_moment + b.drag_moment,
        drag_inertia: a.drag_inertia + b.drag_inertia,
    }
}

/// Composite about a point that lies `arm` before its own.
#[inline(always)]
pub fn composite_shift(body: &Composite, arm: Vec3) -> Composite {
    let swung = arm * body.mass + body.moment * 2.0;
    let round = vec3_dot(arm, swung);
    // Half of both mixed products: their sum is symmetric.
    let own = arm * body.mass + body.moment;
    let moved = Sym3 {
        diagonal: Vec3::new(
            round - (arm.x * own.x + body.moment.x * arm.x),
            round - (arm.y * own.y + body.moment.y * arm.y),
            round - (arm.z * own.z + body.moment.z * arm.z),
        ),
        off: Vec3::new(
            -(arm.y * own.z + body.moment.y * arm.z),
            -(arm.x * own.z + body.moment.x * arm.z),
            -(arm.x * own.y + body.moment.x * arm.y),
        ),
    };
    let reach = vec3_dot(arm, arm * body.drag + body.drag_moment * 2.0);
    Composite {
        inertia: sym3_add(body.inertia, moved),
        moment: body.moment + arm * body.mass,
        mass: body.mass,
        torque: body.torque + vec3_cross(arm, body.force),
        force: body.force,
        drag: body.drag,
        drag_moment: body.drag_moment + arm * body.drag,
        drag_inertia: body.drag_inertia + reach,
    }
}
