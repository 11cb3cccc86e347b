// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/settle.wgsl
//!
//! A leaf on the ground: it keeps the horizontal speed it came with, gains some downhill, loses it to friction and lies
//! down flat on the slope. Speeds and ways are horizontal ones; on a rise s gravity and friction act on these as
//! g s / (1 + s²) and mu g / (1 + s²), exactly so up and down the slope, and a leaf stays where s is below mu.
//!
//! Landing is decided by a float comparison, the one place where the backends' integers could part for a step under
//! the tolerant contract; the step is continuous across that decision, and what it writes is the same a moment later.

use super::record::{Drift, Identity, Place, ground_steps, landed_bits, leaf_source};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{Quat, quat_multiply, quat_normalize};
use crate::arith::vector::Vec3;
use crate::blocks::NEVER;
use crate::context::Context;
use crate::device::terrain::ground::{Slope, ground_lean, ground_rest, ground_slope};
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Square of a quaternion's components below which they count as zero. A leaf that goes on sliding lies down without
    /// end: its tilt would become a subnormal number, which devices may take for zero.
    pub const FLAT_SQUARED: f32 = 1e-14;
}

/// Coulomb friction of a sliding leaf on level ground.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// Speed lost per second in m/s².
    pub loss_m_s2: f32,
    /// Stopping distance per squared speed in s²/m.
    pub stop_s2_m: f32,
}

/// Friction of bare ground.
#[inline(always)]
pub fn ground_friction(cx: &Context<'_>) -> Friction {
    Friction { loss_m_s2: cx.scene.friction_m_s2, stop_s2_m: cx.scene.stop_s2_m }
}

/// A sliding leaf after `seconds` of gravity and Coulomb friction: displacement and velocity left. One that would turn
/// round lies still.
#[inline(always)]
pub fn slide(cx: &Context<'_>, came: Vec3, seconds: f32, slope: Slope, friction: Friction) -> (Vec3, Vec3) {
    let pull = (cx.scene.gravity_m_s2 * seconds) * slope.inv_gain;
    let velocity = Vec3::new(came.x - slope.x * pull, came.y, came.z - slope.z * pull);
    if velocity.x * came.x + velocity.z * came.z < 0.0 {
        return (Vec3::ZERO, Vec3::ZERO);
    }
    let squared = velocity.x * velocity.x + velocity.z * velocity.z;
    if squared < 1e-12 {
        return (Vec3::ZERO, Vec3::ZERO);
    }
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    let left = (speed - (friction.loss_m_s2 * slope.inv_gain) * seconds).max(0.0);
    let stop = squared * (friction.stop_s2_m * slope.gain);
    let way = if left > 0.0 { (0.5 * seconds) * (speed + left) } else { stop };
    (velocity * (way * inverse), velocity * (left * inverse))
}

/// One step towards lying flat, face up or face down, whichever is nearer.
#[inline(always)]
pub fn flatten(q: Quat, kept: f32) -> Quat {
    let face_up = q.y * q.y + q.w * q.w >= q.x * q.x + q.z * q.z;
    let upright = if face_up { 1.0 } else { kept };
    let tilted = if face_up { kept } else { 1.0 };
    let whole = |part: f32| if part * part < FLAT_SQUARED { 0.0 } else { part };
    quat_normalize(Quat::new(
        whole(q.x * tilted),
        whole(q.y * upright),
        whole(q.z * tilted),
        whole(q.w * upright),
    ))
}

/// One step towards lying flat along a slope.
#[inline(always)]
pub fn flatten_on(slope: Slope, q: Quat, kept: f32) -> Quat {
    if slope.gain == 1.0 {
        return flatten(q, kept);
    }
    let lean = ground_lean(slope);
    let back = Quat::new(-lean.x, -lean.y, -lean.z, lean.w);
    quat_multiply(lean, flatten(quat_multiply(back, q), kept))
}

/// Step at which a leaf that has come to rest is recycled, if it ever is.
#[inline(always)]
pub fn recycling_step(cx: &Context<'_>, identity: &Identity) -> u32 {
    let lifetime = cx.scene.sources[leaf_source(identity.appearance) as usize].lifetime_steps;
    if lifetime == 0 { NEVER } else { identity.release.wrapping_add(lifetime) }
}

/// Puts a leaf that has just passed below the resting height on the ground, where its path from `start` met it.
#[expect(clippy::manual_clamp, reason = "written as in WGSL")]
#[inline(always)]
pub fn leaf_land(cx: &Context<'_>, leaf: &mut LeafMut<'_>, start: Vec3) {
    let end = Vec3::from(leaf.place.position);
    let above = ground_rest(cx, start.x, start.z);
    let rise = ground_rest(cx, end.x, end.z) - above;
    let drop = ((start.y - end.y) + rise).max(1e-6);
    let share = ((start.y - above) * reciprocal(drop)).max(0.0).min(1.0);
    let way = end - start;
    let hit = start + way * share;
    let left = (1.0 - share) * cx.scene.dt_s;
    let (slid, velocity) =
        slide(cx, way * cx.scene.inv_dt_s, left, ground_slope(cx, hit.x, hit.z), ground_friction(cx));
    let (x, z) = (hit.x + slid.x, hit.z + slid.z);
    let bits = landed_bits(leaf.place.bits);
    *leaf.place = Place { position: [x, ground_rest(cx, x, z), z], bits };
    *leaf.drift = Drift { velocity: [velocity.x, 0.0, velocity.z], phase: 0 };
    leaf.schedule.event = recycling_step(cx, leaf.identity);
}

/// One step of a leaf on ground that bears no litter.
#[inline(always)]
pub fn leaf_settle(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let steps = ground_steps(leaf.drift.phase);
    let velocity = Vec3::from(leaf.drift.velocity);
    let position = leaf.place.position;
    let slides = velocity.x != 0.0 || velocity.z != 0.0;
    let is_hilly = cx.scene.has_terrain();
    let slope = ground_slope(cx, position[0], position[2]);
    if steps < cx.scene.settle_steps || (slides && is_hilly) {
        let (before, kept) = (Quat::from(leaf.attitude.quaternion), cx.scene.tilt_kept);
        let flat = if is_hilly { flatten_on(slope, before, kept) } else { flatten(before, kept) };
        leaf.attitude.quaternion = flat.to_array();
        // On hills what slides comes to other slopes.
        leaf.drift.phase = if slides && is_hilly { 0 } else { steps + 1 };
    }
    if slides {
        let (slid, left) = slide(cx, velocity, cx.scene.dt_s, slope, ground_friction(cx));
        let (x, z) = (position[0] + slid.x, position[2] + slid.z);
        leaf.place.position = [x, if is_hilly { ground_rest(cx, x, z) } else { position[1] }, z];
        leaf.drift.velocity = left.to_array();
    }
}
