// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/oliapuram_kumar.wgsl
//!
//! Sway of one joint at a time as a rod on a torsion spring, the simplest of the schemes.
//!
//! The thesis that used it entered spring and damper as forces at the rod's middle and crossed them with the rod, which
//! turns them a quarter turn aside: every swing grows, at any stiffness and any step. Here they are torques, stiffness
//! is that of a beam, what the rod carries counts, and the step is implicit.
//!
//! # Source
//! Oliapuram and Kumar, "Realtime forest animation in wind" (2010); the moment of inertia `m l²/3` of a rod is that of
//! all it carries here.

use super::composite::Composite;
use super::quigley::{Moved, Swing};
use super::{Body, Constants, Joint};
use crate::arith::math::reciprocal;
use crate::arith::quaternion::{quat_rotate_back, turn_of_quat};
use crate::arith::vector::Vec3;
use crate::context::Context;

/// Rotation and rate about one axis after a step.
#[inline(always)]
fn rod_step(turn: f32, rate: f32, torque: f32, stiffness: f32, inertia: f32, damping: f32, dt: f32) -> Swing {
    let held = inertia + dt * (damping + dt * stiffness);
    let next = (inertia * rate + dt * (torque - stiffness * turn)) * reciprocal(held);
    Swing { place: turn + dt * next, rate: next }
}

/// Steps a joint that carries `whole`.
#[inline(always)]
pub fn oliapuram_kumar_step(
    cx: &Context<'_>,
    constants: &Constants,
    joint: &Joint,
    body: &Body,
    whole: &Composite,
) -> Moved {
    let dt = cx.scene.sway.dt_s;
    // A rod has the same moment of inertia about both axes across it, and next to none along it.
    let inertia = 0.5 * ((whole.inertia.diagonal.x + whole.inertia.diagonal.y) + whole.inertia.diagonal.z);
    let torque = quat_rotate_back(body.pose, whole.torque) + constants.preload;
    let turn = turn_of_quat(joint.turn);
    let bend = constants.damping * constants.bending + whole.drag_inertia;
    let twist = constants.damping * constants.twisting + whole.drag_inertia;
    let x = rod_step(turn.x, joint.rate.x, torque.x, constants.bending, inertia, bend, dt);
    let y = rod_step(turn.y, joint.rate.y, torque.y, constants.twisting, inertia, twist, dt);
    let z = rod_step(turn.z, joint.rate.z, torque.z, constants.bending, inertia, bend, dt);
    Moved { turn: Vec3::new(x.place, y.place, z.place), rate: Vec3::new(x.rate, y.rate, z.rate) }
}
