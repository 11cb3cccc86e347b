// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds a leaf's state at any moment of a fall through still air, without stepping there.

use super::fall::{Glide, leaf_join};
use super::own::{own_orientation, own_rate, own_scale, turn_to_heading};
use super::record::{
    BLEND_MASK, BLEND_SHIFT, SPECIES_MASK, SPECIES_SHIFT, STAGE_MASK, STAGE_SHIFT, STATE_MASK, STATE_RESTING,
    TABLE_MASK, TABLE_SHIFT,
};
use super::release::leaf_release;
use super::settle::flatten;
use super::store::LeafMut;
use crate::blocks::NEVER;
use crate::context::Context;
use crate::kernel::math::exponential;
use crate::kernel::quaternion::Quat;
use crate::kernel::vector::Vec3;
use crate::motion::feature::{STAGE_COUNT, stage_end};
use crate::motion::lookup::{motion_advance, motion_period};

/// Refinements of the moment of landing.
const LANDING_ROUNDS: u32 = 6;

/// Writes the state of leaf `id` of `source`, `elapsed` steps after its release at step `release`, as a fall through
/// still air gives it; on the ground, flat and still, if that fall is over. Orientation is that of the stage, without
/// the short blend after a join.
pub fn leaf_seek(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32, source: u32, release: u32, elapsed: u32) {
    let rest_height = cx.environment.ground.0[1];
    let target = u64::from(elapsed) << 16;
    fly(cx, leaf, id, source, release, target);
    if elapsed == 0 || leaf.place.position[1] >= rest_height {
        return;
    }
    // The fall is nearly uniform, so the landing is bracketed and refined by the secant through the bracket's ends.
    leaf_release(cx, leaf, id, source, release);
    let (mut early, mut early_height) = (0u64, f64::from(leaf.place.position[1] - rest_height).max(0.0));
    fly(cx, leaf, id, source, release, target);
    let (mut late, mut late_height) = (target, f64::from(leaf.place.position[1] - rest_height));
    for _ in 0..LANDING_ROUNDS {
        let share = early_height / (early_height - late_height);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "share is between 0 and 1"
        )]
        let middle = early + ((late - early) as f64 * share) as u64;
        fly(cx, leaf, id, source, release, middle);
        let height = f64::from(leaf.place.position[1] - rest_height);
        if height > 0.0 {
            (early, early_height) = (middle, height);
            late_height *= 0.5;
        } else {
            (late, late_height) = (middle, height.min(-1e-9));
            early_height *= 0.5;
        }
    }
    rest(cx, leaf, source);
}

/// A flight of `target` (2^-16 steps) from release.
fn fly(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32, source: u32, release: u32, target: u64) {
    leaf_release(cx, leaf, id, source, release);
    let seed = [cx.environment.seed.0[0], cx.environment.seed.0[1]];
    let mut glide = Glide {
        position: leaf.place.position.into(),
        drift: leaf.drift.velocity.into(),
        phase: leaf.drift.phase,
    };
    let mut now = 0;
    loop {
        let stage = (leaf.identity.look >> STAGE_SHIFT) & STAGE_MASK;
        let end = if stage + 1 < STAGE_COUNT {
            u64::from(stage_end(seed, id, leaf.identity.fall_time, stage))
        } else {
            u64::MAX
        };
        glide = glide_long(cx, leaf, glide, end.min(target) - now);
        if end >= target {
            break;
        }
        now = end;
        glide = leaf_join(cx, leaf, glide);
    }
    leaf.place.bits &= !(BLEND_MASK << BLEND_SHIFT);
    leaf.place.position = glide.position.to_array();
    leaf.drift.velocity = glide.drift.to_array();
    leaf.drift.phase = glide.phase;
    let attitude = own_orientation(cx, leaf.place.bits, glide.phase, leaf.course.heading);
    leaf.attitude.quaternion = attitude.to_array();
}

/// Any length of time within one stage, in still air.
fn glide_long(cx: &Context<'_>, leaf: &LeafMut<'_>, glide: Glide, part_q16: u64) -> Glide {
    let environment = cx.environment;
    let table = (leaf.place.bits >> TABLE_SHIFT) & TABLE_MASK;
    let response =
        environment.species[((leaf.place.bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize].response.0;
    let rate = u128::from(own_rate(cx, leaf.course.rate));
    let turned = (rate * u128::from(part_q16)) >> 16;
    #[expect(clippy::cast_possible_truncation, reason = "the low word is the phase, the rest whole periods")]
    let (periods, low) = ((turned >> 32) as f32, turned as u32);
    let to = glide.phase.wrapping_add(low);
    let local =
        motion_advance(&cx.motion, table, glide.phase, to) + motion_period(&cx.motion, table) * periods;
    let scale = own_scale(cx, *leaf.course);
    #[expect(clippy::cast_possible_truncation, reason = "seconds in single precision")]
    let elapsed = (part_q16 as f64 / 65536.0 * f64::from(environment.time.0[0])) as f32;
    let decay = exponential(-elapsed * response[3]);
    let own = turn_to_heading(local, leaf.course.heading >> 16) * scale;
    Glide {
        position: glide.position + (own + glide.drift * (response[2] * (1.0 - decay))),
        drift: glide.drift * decay,
        phase: to,
    }
}

/// Lays a leaf down where it is.
fn rest(cx: &Context<'_>, leaf: &mut LeafMut<'_>, source: u32) {
    let lifetime = cx.environment.sources[source as usize].timing.0[3];
    leaf.place.position[1] = cx.environment.ground.0[1];
    leaf.place.bits = (leaf.place.bits & !STATE_MASK) | STATE_RESTING;
    leaf.drift.velocity = Vec3::ZERO.to_array();
    leaf.drift.phase = cx.environment.counts.0[1];
    leaf.attitude.quaternion = flatten(Quat::from(leaf.attitude.quaternion), 0.0).to_array();
    leaf.course.event = if lifetime == 0 { NEVER } else { leaf.identity.release.wrapping_add(lifetime) };
}
