// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/load.wgsl
//!
//! A segment by itself: its inertia, its weight and what the wind does to it and its leaves.
//!
//! # Source
//! Drag by the velocity relative to the air, and its fall as leaves turn aside: Vogel, "Drag and reconfiguration of broad
//! leaves in high winds" (1989). Across a branch only the wind's part across it counts.

use super::{Articulated, Body, Constants, GRAVITY_M_S2, THIRD};
use crate::context::Context;
use crate::kernel::lane::Real;
use crate::kernel::math::{inverse_sqrt, reciprocal};
use crate::kernel::matrix::{mat3_cross, sym3_axial};
use crate::kernel::quaternion::quat_axis_y;
use crate::kernel::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::wind::sample::wind_at;

/// The wind's hold on a segment at its middle.
#[derive(Clone, Copy, Debug)]
pub struct Drag<R = f32> {
    /// Velocity of the air relative to the middle in m/s.
    pub wind: Vec3<R>,
    /// Force per relative velocity across the wood in N s/m.
    pub wood: R,
    /// Force per relative velocity on the leaves in N s/m.
    pub leaves: R,
}

/// The wind's hold on a segment whose middle moves at `velocity`, from the velocity of the air there.
#[inline(always)]
pub fn segment_drag<R: Real>(
    constants: &Constants<R>,
    axis: Vec3<R>,
    air: Vec3<R>,
    velocity: Vec3<R>,
    bearing: R,
) -> Drag<R> {
    let wind = air - velocity;
    let squared = vec3_dot(wind, wind);
    let along = vec3_dot(wind, axis);
    let tiny = along.all(TINY_SQUARED);
    let across = (squared - along * along).max(tiny);
    let speed_across = across * inverse_sqrt(across);
    let speed = squared * inverse_sqrt(squared.max(tiny));
    let yielding = reciprocal(speed * constants.leaf_yield + 1.0);
    Drag {
        wind,
        wood: constants.wood_drag * speed_across,
        leaves: ((constants.leaf_drag * bearing) * speed) * yielding,
    }
}

/// A segment that bears `bearing` leaves, as a body by itself.
#[inline(always)]
pub fn segment_body<R: Real>(
    cx: &Context<'_>,
    constants: &Constants<R>,
    body: &Body<R>,
    axis: Vec3<R>,
    bearing: R,
) -> Articulated<R> {
    let half = constants.length * 0.5;
    let middle = axis * half;
    let air = wind_at(cx, body.base + middle);
    let velocity = body.velocity + vec3_cross(body.spin, middle);
    let drag = segment_drag(constants, axis, air, velocity, bearing);
    let held = drag.wood + drag.leaves;
    let push = drag.wind * held - axis * (vec3_dot(drag.wind, axis) * drag.wood);

    let leaves = constants.leaf_mass * bearing;
    let mass = constants.mass + leaves;
    let moment = constants.first_moment + leaves * half;
    let across = constants.inertia_across + leaves * ((constants.length * constants.length) * THIRD);
    // Drag at the end of the step: it weighs on the segment like a mass at its middle.
    let dt = cx.environment.time.0[0];
    let added = held * dt;
    let heavy = across + added * (half * half);
    let bare = mass + added;

    let turning = vec3_dot(body.spin, axis);
    let gyration = vec3_cross(body.spin, axis) * ((constants.inertia_along - across) * turning);
    let outward = body.spin * turning - axis * vec3_dot(body.spin, body.spin);
    let weight = Vec3::new(0.0, -GRAVITY_M_S2, 0.0).spread(half);
    Articulated {
        rotation: sym3_axial(axis, constants.inertia_along, heavy),
        coupling: mat3_cross(axis, moment + added * half),
        mass: sym3_axial(axis, bare - drag.wood * dt, bare),
        moment: gyration - (vec3_cross(middle, push) + vec3_cross(axis, weight) * moment),
        force: outward * moment - (push + weight * mass),
    }
}

/// The direction of a segment.
#[inline(always)]
pub fn segment_axis<R: Real>(body: &Body<R>) -> Vec3<R> {
    quat_axis_y(body.pose)
}
