// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/fall.wgsl
//!
//! A leaf in the air: its own motion from the tables, and the wind's drift.
//!
//! The leaf's velocity is its own motion's plus a drift that relaxes towards the wind within the response time
//! tau = U/g, exactly for a wind that holds still during the step. In still air the path does not depend on dt.

use super::own::{on_grid, own_advance, own_orientation, own_rate};
use super::record::{BLEND_MASK, BLEND_SHIFT, Course, SPECIES_MASK, SPECIES_SHIFT, SPIN_SHIFT};
use super::settle::leaf_land;
use super::store::LeafMut;
use crate::context::Context;
use crate::kernel::math::reciprocal;
use crate::kernel::quaternion::{Quat, quat_blend};
use crate::kernel::rng::mul_q16;
use crate::kernel::vector::Vec3;
use crate::wind::sample::wind_at;

crate::shared_constants! {
    /// A whole step in 2^-16 steps.
    pub const WHOLE_STEP: u32 = 65536;
    /// Inverse of it.
    pub const STEP_UNIT: f32 = 1.0 / 65536.0;
}

/// A leaf on its way through one step.
#[derive(Clone, Copy, Debug)]
pub struct Glide {
    /// Position in metres.
    pub position: Vec3,
    /// Drift velocity in m/s.
    pub drift: Vec3,
    /// Phase.
    pub phase: u32,
}

/// A part of a step, and what the drift does in it.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Length in 2^-16 steps.
    pub length: u32,
    /// Drift kept.
    pub decay: f32,
    /// Time constant of the response in s: distance per drift speed until none is left.
    pub tau: f32,
}

/// Moves a leaf through a part of a step within one stage.
#[inline(always)]
pub fn glide_part(
    cx: &Context<'_>,
    glide: Glide,
    bits: u32,
    course: Course,
    wind: Vec3,
    part: Part,
) -> Glide {
    let end = glide.phase.wrapping_add(mul_q16(own_rate(cx, course.rate), part.length));
    let own = own_advance(cx, bits, course, glide.phase, end);
    let before = glide.drift - wind;
    let after = before * part.decay;
    let spent = on_grid(cx, before * part.tau) - on_grid(cx, after * part.tau);
    let carried = wind * ((part.length as f32 * STEP_UNIT) * cx.environment.time.0[0]);
    Glide { position: glide.position + ((own + spent) + carried), drift: wind + after, phase: end }
}

/// Spin angle one step on, in place in the bits.
#[inline(always)]
pub fn spin_advance(cx: &Context<'_>, bits: u32, heading: u32) -> u32 {
    let fastest = cx.environment.species[((bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize].scales.0[3];
    let rate = ((heading << 16) as i32) >> 16;
    let turn = (rate * fastest as i32) >> 17;
    bits.wrapping_add((turn as u32) << SPIN_SHIFT)
}

/// Writes back a leaf that has come from `start` to the end of its step: spin, orientation, and the ground.
#[inline(always)]
pub fn glide_end(cx: &Context<'_>, leaf: &mut LeafMut<'_>, start: Vec3, glide: Glide) {
    let course = *leaf.course;
    let mut bits = spin_advance(cx, leaf.place.bits, course.heading);
    let mut attitude = own_orientation(cx, bits, glide.phase, course.heading);
    let blend = (bits >> BLEND_SHIFT) & BLEND_MASK;
    if blend != 0 {
        attitude = quat_blend(Quat::from(leaf.attitude.quaternion), attitude, reciprocal(blend as f32));
        bits -= 1 << BLEND_SHIFT;
    }
    leaf.attitude.quaternion = attitude.to_array();
    leaf.place.bits = bits;
    leaf.place.position = glide.position.to_array();
    leaf.drift.velocity = glide.drift.to_array();
    leaf.drift.phase = glide.phase;
    if glide.position.y < cx.environment.ground.0[1] {
        leaf_land(cx, leaf, start);
    }
}

/// One step of a falling leaf that has no event in it.
#[inline(always)]
pub fn leaf_fall(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let start = Vec3::from(leaf.place.position);
    let response =
        cx.environment.species[((leaf.place.bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize].response.0;
    let wind = wind_at(cx, start);
    let glide = Glide { position: start, drift: Vec3::from(leaf.drift.velocity), phase: leaf.drift.phase };
    let part = Part { length: WHOLE_STEP, decay: response[0], tau: response[2] };
    glide_end(cx, leaf, start, glide_part(cx, glide, leaf.place.bits, *leaf.course, wind, part));
}
