// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/coast.wgsl
//!
//! Steps between two solutions of the joints: segments go on as they move.

use super::outward::shortened;
use super::{Body, TURN_LIMIT};
use crate::arith::lane::Real;
use crate::arith::quaternion::{quat_multiply, quat_of_turn, quat_renormalize};
use crate::context::Context;

/// Segment after a step at the velocities that it has.
#[inline(always)]
pub fn segment_coast<R: Real>(cx: &Context<'_>, body: &Body<R>) -> Body<R> {
    let dt = body.base.x.all(cx.scene.dt_s);
    let turn = shortened(body.spin * dt, dt.all(TURN_LIMIT));
    Body {
        base: body.base + body.velocity * dt,
        pose: quat_renormalize(quat_multiply(quat_of_turn(turn), body.pose)),
        ..*body
    }
}
