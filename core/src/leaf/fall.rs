// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/fall.wgsl
//!
//! A leaf in the air: its own motion from the tables, the wind's drift, and the joins between stages.
//!
//! The leaf's velocity is its own motion's plus a drift that relaxes towards the wind within the response time
//! tau = U/g. At a join the drift takes up the difference between the old motion's velocity and the new one's, so
//! that position and velocity go on without a jump; at release it cancels the first motion's velocity, so that the
//! leaf starts from rest with an acceleration of g. Both relax exactly: in still air the path does not depend on dt.

use super::own::{own_orientation, own_rate, own_scale, own_velocity, turn_to_heading};
use super::record::{
    BLEND_MASK, BLEND_SHIFT, Course, HALF_MASK, PRIMITIVE_MASK, PRIMITIVE_SHIFT, SOURCE_MASK, SOURCE_SHIFT,
    SPECIES_MASK, SPECIES_SHIFT, SPIN_SHIFT, STAGE_MASK, STAGE_SHIFT, TABLE_MASK, TABLE_SHIFT,
};
use super::release::{next_event, release_rate, release_ratio, release_size_speed};
use super::settle::leaf_land;
use super::store::LeafMut;
use crate::context::Context;
use crate::kernel::math::{exponential, reciprocal};
use crate::kernel::quaternion::{Quat, quat_blend};
use crate::kernel::rng::{mul_q16, random};
use crate::kernel::vector::Vec3;
use crate::motion::feature::{STAGE_COUNT, STREAM_LOOK, stage_end, stage_words, transition_next};
use crate::motion::lookup::motion_advance;
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

/// Moves a leaf through a part of a step within one stage. `decay` and `travel` belong to that part: drift kept, and
/// distance per drift speed in s.
#[inline(always)]
pub fn glide_part(
    cx: &Context<'_>,
    glide: Glide,
    bits: u32,
    course: Course,
    wind: Vec3,
    part_q16: u32,
    decay: f32,
    travel: f32,
) -> Glide {
    let to = glide.phase.wrapping_add(mul_q16(own_rate(cx, course.rate), part_q16));
    let local = motion_advance(&cx.motion, (bits >> TABLE_SHIFT) & TABLE_MASK, glide.phase, to);
    let own = turn_to_heading(local, course.heading >> 16) * own_scale(cx, course);
    let relative = glide.drift - wind;
    let carried = wind * ((part_q16 as f32 * STEP_UNIT) * cx.environment.time.0[0]) + relative * travel;
    Glide { position: glide.position + (own + carried), drift: wind + relative * decay, phase: to }
}

/// Ends the current stage: draws the next motion and hands the difference of velocities to the drift.
#[inline(always)]
pub fn leaf_join(cx: &Context<'_>, leaf: &mut LeafMut<'_>, glide: Glide) -> Glide {
    let seed = [cx.environment.seed.0[0], cx.environment.seed.0[1]];
    let id = leaf.identity.id;
    let bits = leaf.place.bits;
    let before = own_velocity(cx, bits, glide.phase, *leaf.course);
    let stage = ((leaf.identity.look >> STAGE_SHIFT) & STAGE_MASK) + 1;
    let species = &cx.environment.species[((bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize];
    let words = stage_words(seed, id, stage);
    let primitive = transition_next(species, (bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK, words[0]);
    let ratio = release_ratio(release_size_speed(species, random(seed, id, STREAM_LOOK)));

    leaf.identity.look = (leaf.identity.look & !(STAGE_MASK << STAGE_SHIFT)) | (stage << STAGE_SHIFT);
    leaf.course.rate = release_rate(species, primitive, ratio);
    leaf.course.heading = (words[2] & (HALF_MASK << 16)) | (leaf.course.heading & HALF_MASK);
    leaf.course.event = next_event(
        cx,
        id,
        leaf.identity.release,
        leaf.identity.fall_time,
        stage,
        (leaf.identity.look >> SOURCE_SHIFT) & SOURCE_MASK,
    );
    leaf.place.bits = (bits & !((PRIMITIVE_MASK << PRIMITIVE_SHIFT) | (BLEND_MASK << BLEND_SHIFT)))
        | (primitive << PRIMITIVE_SHIFT)
        | (cx.environment.counts.0[2] << BLEND_SHIFT);
    let after = own_velocity(cx, leaf.place.bits, words[1], *leaf.course);
    Glide { position: glide.position, drift: glide.drift + (before - after), phase: words[1] }
}

/// Spin angle one step on, in place in the bits.
#[inline(always)]
pub fn spin_advance(cx: &Context<'_>, bits: u32, heading: u32) -> u32 {
    let species = &cx.environment.species[((bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize];
    let rate = ((heading << 16) as i32) >> 16;
    let step = (rate * species.scales.0[3] as i32) >> 17;
    bits.wrapping_add((step as u32) << SPIN_SHIFT)
}

/// One step of a falling leaf.
#[inline(always)]
pub fn leaf_fall(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let start = Vec3::from(leaf.place.position);
    let response =
        cx.environment.species[((leaf.place.bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize].response.0;
    let wind = wind_at(cx, start);
    let mut glide =
        Glide { position: start, drift: Vec3::from(leaf.drift.velocity), phase: leaf.drift.phase };
    let mut done = 0;
    for _ in 1..STAGE_COUNT {
        if cx.step.index.0[0] >= leaf.course.event {
            let seed = [cx.environment.seed.0[0], cx.environment.seed.0[1]];
            let stage = (leaf.identity.look >> STAGE_SHIFT) & STAGE_MASK;
            let end = stage_end(seed, leaf.identity.id, leaf.identity.fall_time, stage) & HALF_MASK;
            let part = end.max(done) - done;
            let elapsed = (part as f32 * STEP_UNIT) * cx.environment.time.0[0];
            let decay = exponential((0.0 - elapsed) * response[3]);
            glide = glide_part(
                cx,
                glide,
                leaf.place.bits,
                *leaf.course,
                wind,
                part,
                decay,
                response[2] * (1.0 - decay),
            );
            glide = leaf_join(cx, leaf, glide);
            done = end.max(done);
        }
    }
    let mut decay = response[0];
    let mut travel = response[1];
    if done != 0 {
        let elapsed = ((WHOLE_STEP - done) as f32 * STEP_UNIT) * cx.environment.time.0[0];
        decay = exponential((0.0 - elapsed) * response[3]);
        travel = response[2] * (1.0 - decay);
    }
    glide = glide_part(cx, glide, leaf.place.bits, *leaf.course, wind, WHOLE_STEP - done, decay, travel);

    let mut bits = spin_advance(cx, leaf.place.bits, leaf.course.heading);
    let mut attitude = own_orientation(cx, bits, glide.phase, leaf.course.heading);
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
