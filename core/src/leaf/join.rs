// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/join.wgsl
//!
//! The joins between the stages of a fall.
//!
//! At a join the drift takes up the difference between the old motion's velocity and the new one's, so that position
//! and velocity go on without a jump, at the exact moment within the step; orientation blends over a few steps.

use super::fall::{Glide, Part, Response, STEP_UNIT, WHOLE_STEP, glide_end, glide_part, response_of};
use super::own::own_velocity;
use super::record::{
    BLEND_MASK, BLEND_SHIFT, HALF_MASK, PRIMITIVE_MASK, PRIMITIVE_SHIFT, SOURCE_MASK, SOURCE_SHIFT,
    SPECIES_MASK, SPECIES_SHIFT, STAGE_MASK, STAGE_SHIFT,
};
use super::release::{next_event, release_rate, release_ratio, release_size_speed};
use super::store::LeafMut;
use crate::context::Context;
use crate::kernel::math::exponential;
use crate::kernel::rng::random;
use crate::kernel::vector::Vec3;
use crate::motion::feature::{STAGE_COUNT, STREAM_LOOK, stage_end, stage_words, transition_next};
use crate::wind::sample::wind_at;

/// Ends the current stage: draws the next motion and hands the difference of velocities to the drift.
#[inline(always)]
pub fn leaf_join(cx: &Context<'_>, leaf: &mut LeafMut<'_>, glide: Glide) -> Glide {
    let seed = cx.environment.seed;
    let id = leaf.identity.id;
    let bits = leaf.place.bits;
    let before = own_velocity(cx, bits, glide.phase, (*leaf.course).into());
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
        | (cx.environment.blend_steps << BLEND_SHIFT);
    let after = own_velocity(cx, leaf.place.bits, words[1], (*leaf.course).into());
    Glide { position: glide.position, drift: glide.drift + (before - after), phase: words[1] }
}

/// Part of a step of any length, for a species of that response.
#[inline(always)]
pub fn part_of_step(cx: &Context<'_>, response: Response, length: u32) -> Part {
    let elapsed = (length as f32 * STEP_UNIT) * cx.environment.dt_s;
    let decay = exponential((0.0 - elapsed) * response.inv_time_constant);
    Part { length, decay, tau: response.time_constant_s }
}

/// One step of a falling leaf with the joins that come within it.
#[inline(always)]
pub fn leaf_fall_joining(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let start = Vec3::from(leaf.place.position);
    let response = response_of(cx, leaf.place.bits);
    let wind = wind_at(cx, start);
    let seed = cx.environment.seed;
    let mut glide =
        Glide { position: start, drift: Vec3::from(leaf.drift.velocity), phase: leaf.drift.phase };
    let mut done = 0;
    for _ in 1..STAGE_COUNT {
        if cx.step.index >= leaf.course.event {
            let stage = (leaf.identity.look >> STAGE_SHIFT) & STAGE_MASK;
            let end = done.max(stage_end(seed, leaf.identity.id, leaf.identity.fall_time, stage) & HALF_MASK);
            let part = part_of_step(cx, response, end - done);
            glide = glide_part(cx, glide, leaf.place.bits, (*leaf.course).into(), wind, part);
            glide = leaf_join(cx, leaf, glide);
            done = end;
        }
    }
    let part = part_of_step(cx, response, WHOLE_STEP - done);
    let moved = glide_part(cx, glide, leaf.place.bits, (*leaf.course).into(), wind, part);
    glide_end(cx, leaf, start, moved);
}
