// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/launch.wgsl
//!
//! A leaf that flies as a body is let go: held how, with which quirks.

use super::record::{HALF_MASK, QUIRK_SHIFT, SPECIES_MASK, SPECIES_SHIFT};
use super::store::LeafMut;
use crate::context::Context;
use crate::flight::block::HOLD_RANDOM;
use crate::kernel::math::{inverse_sqrt, sin_cos_turns};
use crate::kernel::quaternion::{Quat, quat_multiply};
use crate::kernel::rng::{random, triangular, unit_float};
use crate::kernel::vector::TINY_SQUARED;

crate::shared_constants! {
    /// Random words of how a body is held.
    pub const STREAM_HOLD: u32 = 34;
    /// Random words of a body's quirks.
    pub const STREAM_QUIRKS: u32 = 35;
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

/// How body `id` of a species is held before it is let go.
#[inline(always)]
pub fn hold_pose(cx: &Context<'_>, species: u32, id: u32) -> Quat {
    let seed = cx.environment.seed;
    let words = random(seed, id, STREAM_HOLD);
    let body = &cx.environment.bodies[species as usize];
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
    let species = (leaf.place.bits >> SPECIES_SHIFT) & SPECIES_MASK;
    leaf.attitude.quaternion = hold_pose(cx, species, id).to_array();
    leaf.drift.phase = 0;
    leaf.course.rate = 0;
    leaf.course.heading = 0;
}

/// The quirks of body `id`: four of four bits.
#[inline(always)]
pub fn quirks_of(cx: &Context<'_>, id: u32) -> u32 {
    random(cx.environment.seed, id, STREAM_QUIRKS)[0] & HALF_MASK
}

/// Gives a leaf that takes wing its quirks, and nothing yet to remember.
#[inline(always)]
pub fn leaf_launch(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32) {
    leaf.course.size = (leaf.course.size & HALF_MASK) | (quirks_of(cx, id) << QUIRK_SHIFT);
    leaf.identity.fall_time = 0;
}
