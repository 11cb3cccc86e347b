// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/join.wgsl
//!
//! The joins between the stages of a fall.
//!
//! At a join the drift takes up the difference between the old motion's velocity and the new one's, so that position
//! and velocity go on without a jump, at the exact moment within the step; orientation blends over a few steps.

use super::fall::{Glide, Part, Response, glide_end, glide_of, glide_part, response_of};
use super::own::{STEP_UNIT, WHOLE_STEP, motion_params, own_velocity};
use super::record::{
    HALF_MASK, Schedule, heading_word, leaf_primitive, leaf_source, leaf_species, leaf_stage, with_blend,
    with_primitive, with_stage,
};
use super::release::{next_event, release_rate, release_ratio, release_size_speed};
use super::settle::leaf_land;
use super::strike::leaf_strike;
use crate::arith::math::exponential;
use crate::arith::rng::random;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::motion::feature::{STAGE_COUNT, STREAM_TRAITS, stage_end, stage_words, transition_next};
use crate::device::terrain::ground::ground_met;
use crate::device::wind::packed::wind_unpack;
use crate::leaf::LeafMut;

/// Ends the current stage: draws the next motion and hands the difference of velocities to the drift.
#[inline(always)]
pub fn leaf_join(cx: &Context<'_>, leaf: &mut LeafMut<'_>, glide: Glide) -> Glide {
    let seed = cx.scene.seed;
    let identity = *leaf.identity;
    let id = identity.id;
    let old_bits = leaf.place.bits;
    let old = *leaf.schedule;
    let before = own_velocity(cx, old_bits, glide.phase, motion_params(old));
    let stage = leaf_stage(identity.appearance) + 1;
    let species = &cx.scene.species[leaf_species(old_bits) as usize];
    let words = stage_words(seed, id, stage);
    let primitive = transition_next(species, leaf_primitive(old_bits), words[0]);
    let ratio = release_ratio(release_size_speed(species, random(seed, id, STREAM_TRAITS)));

    leaf.identity.appearance = with_stage(identity.appearance, stage);
    let source = leaf_source(identity.appearance);
    let schedule = Schedule {
        event: next_event(cx, id, identity.release, identity.fall_time, stage, source),
        rate: release_rate(species, primitive, ratio),
        size: old.size,
        heading: heading_word(words[2] >> 16, old.heading),
    };
    *leaf.schedule = schedule;
    let bits = with_blend(with_primitive(old_bits, primitive), cx.scene.blend_steps);
    leaf.place.bits = bits;
    let after = own_velocity(cx, bits, words[1], motion_params(schedule));
    Glide { position: glide.position, drift: glide.drift + (before - after), phase: words[1] }
}

/// Part of a step of any length, for a species of that response.
#[inline(always)]
pub fn part_of_step(cx: &Context<'_>, response: Response, length: u32) -> Part {
    let elapsed = (length as f32 * STEP_UNIT) * cx.scene.dt_s;
    let decay = exponential((-elapsed) * response.inv_time_constant);
    Part { length, decay, tau: response.time_constant_s }
}

/// One step of a falling leaf with the joins that come within it. One that strikes a solid part is left to
/// [`leaf_fly`](super::fly::leaf_fly).
#[inline(always)]
pub fn leaf_fall_joining(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let start = Vec3::from(leaf.place.position);
    let response = response_of(cx, leaf.place.bits);
    let seed = cx.scene.seed;
    let mut glide = glide_of(leaf.place, leaf.drift);
    let wind = wind_unpack(*leaf.air);
    let mut done = 0;
    for _ in 1..STAGE_COUNT {
        if cx.step.index >= leaf.schedule.event {
            let stage = leaf_stage(leaf.identity.appearance);
            let end = done.max(stage_end(seed, leaf.identity.id, leaf.identity.fall_time, stage) & HALF_MASK);
            let part = part_of_step(cx, response, end - done);
            glide = glide_part(cx, glide, leaf.place.bits, motion_params(*leaf.schedule), wind, part);
            glide = leaf_join(cx, leaf, glide);
            done = end;
        }
    }
    let part = part_of_step(cx, response, WHOLE_STEP - done);
    let (bits, schedule) = (leaf.place.bits, *leaf.schedule);
    let moved = glide_part(cx, glide, bits, motion_params(schedule), wind, part);
    if leaf_strike(cx, leaf, moved.position) {
        return;
    }
    glide_end(cx, leaf, moved, bits, schedule.heading);
    if ground_met(cx, moved.position) {
        leaf_land(cx, leaf, start);
    }
}
