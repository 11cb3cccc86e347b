// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/settle.wgsl
//!
//! A leaf on the ground: it keeps the horizontal speed it came with, loses it to friction and lies down flat.
//!
//! Landing is decided by a float comparison, the one place where the backends' integers could part for a step under
//! the tolerant contract; the step is continuous across that decision, and what it writes is the same a moment later.

use super::record::{BLEND_MASK, BLEND_SHIFT, SOURCE_MASK, SOURCE_SHIFT, STATE_MASK, STATE_RESTING};
use super::store::LeafMut;
use crate::blocks::NEVER;
use crate::context::Context;
use crate::kernel::math::{inverse_sqrt, reciprocal};
use crate::kernel::quaternion::{Quat, quat_normalize};
use crate::kernel::vector::Vec3;

/// A sliding leaf after `seconds` of Coulomb friction: displacement and velocity left.
#[inline(always)]
pub fn slide(cx: &Context<'_>, velocity: Vec3, seconds: f32) -> (Vec3, Vec3) {
    let squared = velocity.x * velocity.x + velocity.z * velocity.z;
    if squared < 1e-12 {
        return (Vec3::ZERO, Vec3::ZERO);
    }
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    let left = (speed - cx.environment.ground.0[2] * seconds).max(0.0);
    let way =
        if left > 0.0 { (0.5 * seconds) * (speed + left) } else { squared * cx.environment.ground.0[3] };
    (velocity * (way * inverse), velocity * (left * inverse))
}

/// One step towards lying flat, face up or face down, whichever is nearer.
#[inline(always)]
pub fn flatten(q: Quat, kept: f32) -> Quat {
    let face_up = q.y * q.y + q.w * q.w >= q.x * q.x + q.z * q.z;
    let upright = if face_up { 1.0 } else { kept };
    let tilted = if face_up { kept } else { 1.0 };
    quat_normalize(Quat::new(q.x * tilted, q.y * upright, q.z * tilted, q.w * upright))
}

/// Puts a leaf that has just passed below the resting height on the ground, where its path from `start` met it.
#[expect(clippy::manual_clamp, reason = "written as in WGSL")]
#[inline(always)]
pub fn leaf_land(cx: &Context<'_>, leaf: &mut LeafMut<'_>, start: Vec3) {
    let rest_height = cx.environment.ground.0[1];
    let end = Vec3::from(leaf.place.position);
    let drop = (start.y - end.y).max(1e-6);
    let share = ((start.y - rest_height) * reciprocal(drop)).max(0.0).min(1.0);
    let way = end - start;
    let hit = start + way * share;
    let dt = cx.environment.time.0[0];
    let (slid, velocity) = slide(cx, way * cx.environment.time.0[1], (1.0 - share) * dt);
    let lifetime =
        cx.environment.sources[((leaf.identity.look >> SOURCE_SHIFT) & SOURCE_MASK) as usize].timing.0[3];
    leaf.place.position = [hit.x + slid.x, rest_height, hit.z + slid.z];
    leaf.place.bits = (leaf.place.bits & !(STATE_MASK | (BLEND_MASK << BLEND_SHIFT))) | STATE_RESTING;
    leaf.drift.velocity = [velocity.x, 0.0, velocity.z];
    leaf.drift.phase = 0;
    leaf.course.event = if lifetime == 0 { NEVER } else { leaf.identity.release.wrapping_add(lifetime) };
}

/// One step of a leaf on the ground.
#[inline(always)]
pub fn leaf_settle(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let counter = leaf.drift.phase;
    let velocity = Vec3::from(leaf.drift.velocity);
    if counter < cx.environment.counts.0[1] {
        let flat = flatten(Quat::from(leaf.attitude.quaternion), cx.environment.settle.0[0]);
        leaf.attitude.quaternion = flat.to_array();
        leaf.drift.phase = counter + 1;
    }
    if velocity.x != 0.0 || velocity.z != 0.0 {
        let (slid, left) = slide(cx, velocity, cx.environment.time.0[0]);
        leaf.place.position =
            [leaf.place.position[0] + slid.x, leaf.place.position[1], leaf.place.position[2] + slid.z];
        leaf.drift.velocity = left.to_array();
    }
}
