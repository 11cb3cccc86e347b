// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/carry.wgsl
//!
//! A leaf on its twig: it goes where the branch goes, turns aside in the wind and flutters, and its petiole breaks.
//!
//! Whether it breaks is drawn afresh every few steps: a random word against the chance that its strength, the season and
//! the speed of the air leave it (see `environment/foliage.rs`). The load of its own inertia is left out: at the few m/s²
//! of a swaying twig a leaf of half a gram pulls with some thousandths of a newton, a tenth of what the wind does.

use super::petiole::{
    PETIOLE_CLASS_MASK, PETIOLE_CLASS_SHIFT, PETIOLE_CLUSTER_SHIFT, PETIOLE_KIND_MASK, PETIOLE_KIND_SHIFT,
    PETIOLE_REACH_MASK, PETIOLE_REACH_SHIFT, PETIOLE_REACH_UNIT, PETIOLE_ROWS, Petiole, SHED_CLASSES,
    SHED_INTERVAL, SHED_SPEEDS,
};
use super::record::{
    Attitude, BLEND_MASK, BLEND_SHIFT, Course, Drift, HALF_MASK, Place, STATE_ATTACHED, STATE_MASK,
    STATE_RESTING,
};
use super::store::LeafMut;
use crate::blocks::{NEVER, SOURCE_TREES};
use crate::context::Context;
use crate::kernel::math::{inverse_sqrt, reciprocal, sin_cos_turns};
use crate::kernel::quaternion::{
    Quat, quat_multiply, quat_of_turn, quat_renormalize, quat_rotate, quat_rotate_back,
};
use crate::kernel::rng::philox;
use crate::kernel::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::layout::Uint4;
use crate::tree::sway::Body;
use crate::wind::sample::wind_at;

crate::shared_constants! {
    /// Stream of random words that break petioles.
    pub const STREAM_SHED: u32 = 32;
    /// Speed of the air in m/s at which a leaf has turned half as far aside as it ever will.
    pub const LEAN_SPEED: f32 = 6.0;
    /// Furthest that the wind turns a leaf aside, in rad.
    pub const LEAN_MOST: f32 = 0.6;
    /// Most that a leaf flutters about its midrib, in rad.
    pub const FLUTTER_ROLL: f32 = 0.25;
    /// Most that it flutters about its blade's own cross axis, in rad.
    pub const FLUTTER_PITCH: f32 = 0.12;
    /// Share of a new look at the wind in what a leaf has got used to.
    pub const HABIT_SHARE: f32 = 0.25;
}

/// The hot records of a leaf on a twig.
#[derive(Debug)]
pub struct CarriedLeaf<'a> {
    /// Where and what.
    pub place: &'a mut Place,
    /// Carried how.
    pub drift: &'a mut Drift,
    /// Turned how.
    pub attitude: &'a mut Attitude,
    /// Up to what.
    pub course: &'a mut Course,
}

impl<'a> From<LeafMut<'a>> for CarriedLeaf<'a> {
    fn from(leaf: LeafMut<'a>) -> Self {
        Self { place: leaf.place, drift: leaf.drift, attitude: leaf.attitude, course: leaf.course }
    }
}

/// Chance, of 2^32, that a petiole breaks in air of that speed, at one of its looks.
#[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
#[inline(always)]
pub fn shed_chance(cx: &Context<'_>, facts: u32, speed: f32) -> u32 {
    let kind = (facts >> PETIOLE_KIND_SHIFT) & PETIOLE_KIND_MASK;
    let strength = (facts >> PETIOLE_CLASS_SHIFT) & PETIOLE_CLASS_MASK;
    let level = (speed.floor() as i32 as u32).min(SHED_SPEEDS - 1);
    let index = (kind * SHED_CLASSES + strength) * SHED_SPEEDS + level;
    cx.petioles[(index >> 2) as usize].0[(index & 3) as usize]
}

/// Places a leaf on its segment: orientation from the air that it has got used to, position, velocity.
#[inline(always)]
pub fn leaf_hang(cx: &Context<'_>, leaf: &mut CarriedLeaf<'_>, slot: u32, petiole: &Petiole, segment: &Body) {
    let habit = f32::from_bits(leaf.drift.phase);
    let still = quat_multiply(segment.pose, Quat::from(petiole.rest));
    let tip = quat_rotate(still, Vec3::new(0.0, 0.0, 1.0));
    let side = quat_rotate(still, Vec3::new(1.0, 0.0, 0.0));
    let wind = Vec3::new(cx.environment.wind.mean.0[0], 0.0, cx.environment.wind.mean.0[1]);
    let share = habit * reciprocal(habit + LEAN_SPEED);
    let unrest = share * share;
    let rate = cx.environment.crowns.0[2];
    let own_rate = rate + (rate >> 5) * (slot & 15);
    let phase = own_rate.wrapping_mul(cx.step.index.0[0]).wrapping_add(slot.wrapping_mul(0x9E37_79B9));
    let (roll, _) = sin_cos_turns(phase);
    let (_, pitch) = sin_cos_turns(phase << 1);
    let lean = vec3_cross(tip, wind) * (share * LEAN_MOST);
    let flutter = tip * ((unrest * FLUTTER_ROLL) * roll) + side * ((unrest * FLUTTER_PITCH) * pitch);
    let attitude = quat_renormalize(quat_multiply(quat_of_turn(lean + flutter), still));
    let reach = ((petiole.facts >> PETIOLE_REACH_SHIFT) & PETIOLE_REACH_MASK) as f32 * PETIOLE_REACH_UNIT;
    let arm =
        quat_rotate(segment.pose, Vec3::from(petiole.at)) + quat_rotate(attitude, Vec3::new(0.0, 0.0, reach));
    leaf.attitude.quaternion = attitude.to_array();
    leaf.place.position = (segment.base + arm).to_array();
    leaf.drift.velocity = (segment.velocity + vec3_cross(segment.spin, arm)).to_array();
}

/// Size of a leaf on its twig: its own in the high half, as it is drawn in the low one.
#[inline(always)]
pub fn leaf_size_on_twig(size: u32, facts: u32) -> u32 {
    (size << 16) | ((size * (facts >> PETIOLE_CLUSTER_SHIFT)) >> 4).min(HALF_MASK)
}

/// The petiole of a tree's slot.
pub fn petiole_of(cx: &Context<'_>, slot: u32) -> Petiole {
    let first = (cx.environment.crowns.0[1] + slot * PETIOLE_ROWS) as usize;
    let rows: &[Uint4; PETIOLE_ROWS as usize] = cx.petioles[first..].first_chunk().expect("a slot of a tree");
    bytemuck::cast(*rows)
}

/// One step of the leaf in a slot of a tree, after its segment has moved: what the number of leaves on the segment
/// changes by, in two's complement.
#[inline(always)]
pub fn leaf_carry(
    cx: &Context<'_>,
    leaf: &mut CarriedLeaf<'_>,
    slot: u32,
    petiole: &Petiole,
    segment: &Body,
) -> u32 {
    let now = cx.step.index.0[0];
    let mut change = 0;
    let is_back = (leaf.place.bits & STATE_MASK) == STATE_RESTING
        && cx.environment.sources[SOURCE_TREES as usize].timing.0[3] != 0
        && now >= leaf.course.event;
    if is_back {
        leaf.place.bits = (leaf.place.bits & !(STATE_MASK | (BLEND_MASK << BLEND_SHIFT))) | STATE_ATTACHED;
        leaf.course.event = NEVER;
        leaf.course.size = leaf_size_on_twig(leaf.course.size & HALF_MASK, petiole.facts);
        leaf.drift.phase = 0;
        change = 1;
    }
    if (leaf.place.bits & STATE_MASK) != STATE_ATTACHED || now >= leaf.course.event {
        return change;
    }
    if (now.wrapping_add(slot) & (SHED_INTERVAL - 1)) == 0 {
        let arm = quat_rotate(segment.pose, Vec3::from(petiole.at));
        let velocity = segment.velocity + vec3_cross(segment.spin, arm);
        let relative = wind_at(cx, segment.base + arm) - velocity;
        let squared = vec3_dot(relative, relative);
        let speed = squared * inverse_sqrt(squared.max(TINY_SQUARED));
        let habit = f32::from_bits(leaf.drift.phase);
        leaf.drift.phase = (habit + (speed - habit) * HABIT_SHARE).to_bits();
        let seed = [cx.environment.seed.0[0], cx.environment.seed.0[1]];
        if philox(seed, [slot, STREAM_SHED, now, 0])[0] < shed_chance(cx, petiole.facts, speed) {
            leaf.course.event = now + 1;
            change = change.wrapping_sub(1);
        }
    }
    leaf_hang(cx, leaf, slot, petiole, segment);
    if leaf.course.event == now + 1 {
        // What flies as a body takes the twig's spin along.
        let spin = quat_rotate_back(Quat::from(leaf.attitude.quaternion), segment.spin);
        leaf.drift.phase = spin.x.to_bits();
        leaf.course.rate = spin.y.to_bits();
        leaf.course.heading = spin.z.to_bits();
    }
    change
}
