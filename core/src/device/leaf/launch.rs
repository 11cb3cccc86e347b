// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/launch.wgsl
//!
//! The release of a leaf that flies as a body: its pose before, its asymmetries.

use super::record::{HALF_MASK, leaf_species, with_asymmetry};
use crate::arith::math::{inverse_sqrt, sin_cos_turns};
use crate::arith::quaternion::{Quat, quat_multiply};
use crate::arith::rng::{random, triangular, unit_float};
use crate::arith::vector::TINY_SQUARED;
use crate::context::Context;
use crate::flight::block::HOLD_RANDOM;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Random words of the pose of a body before its release.
    pub const STREAM_HOLD: u32 = 34;
    /// Random words of a body's asymmetries.
    pub const STREAM_ASYMMETRY: u32 = 35;
}

/// A turn about y by an angle in 2^-32 turns.
#[inline(always)]
pub fn turn_about_y(angle: u32) -> Quat {
    let (sine, cosine) = sin_cos_turns(angle >> 1);
    Quat::new(0.0, sine, 0.0, cosine)
}

/// Any orientation, each as likely as any other, from random words.
///
/// # Source
/// Shoemake, "Uniform random rotations" (1992).
#[inline(always)]
pub fn random_pose(words: [u32; 4]) -> Quat {
    let share = unit_float(words[0]);
    let rest = 1.0 - share;
    let (sine, cosine) = sin_cos_turns(words[1]);
    let (other_sine, other_cosine) = sin_cos_turns(words[2]);
    let low = rest * inverse_sqrt(rest.max(TINY_SQUARED));
    let high = share * inverse_sqrt(share.max(TINY_SQUARED));
    Quat::new(low * sine, low * cosine, high * other_sine, high * other_cosine)
}

/// Pose of body `id` of a species before its release.
#[inline(always)]
pub fn hold_pose(cx: &Context<'_>, species: u32, id: u32) -> Quat {
    let seed = cx.scene.seed;
    let words = random(seed, id, STREAM_HOLD);
    let body = &cx.scene.bodies[species as usize];
    if body.hold_kind == HOLD_RANDOM {
        return random_pose(words);
    }
    let spread = (body.hold_spread as i32 * (triangular(words[0]) >> 4)) >> 12;
    let tilt = (body.hold_tilt as i32 + spread) as u32;
    let (sine, cosine) = sin_cos_turns((tilt << 16) >> 1);
    let tilted = quat_multiply(Quat::new(sine, 0.0, 0.0, cosine), turn_about_y(words[1]));
    quat_multiply(turn_about_y(words[2]), tilted)
}

/// Holds a leaf still.
#[inline(always)]
pub fn leaf_hold(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32) {
    leaf.attitude.quaternion = hold_pose(cx, leaf_species(leaf.place.bits), id).to_array();
    leaf.drift.phase = 0;
    leaf.schedule.rate = 0;
    leaf.schedule.heading = 0;
}

/// Asymmetries of body `id`: four of four bits.
#[inline(always)]
pub fn random_asymmetry(cx: &Context<'_>, id: u32) -> u32 {
    random(cx.scene.seed, id, STREAM_ASYMMETRY)[0] & HALF_MASK
}

/// Gives a leaf that takes wing its asymmetries, and a regime without events.
#[inline(always)]
pub fn leaf_launch(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32) {
    leaf.schedule.size = with_asymmetry(leaf.schedule.size, random_asymmetry(cx, id));
    leaf.identity.fall_time = 0;
}
