// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/carry.wgsl
//!
//! A leaf on its twig: it goes where the branch goes, leans and flutters in the wind, and its petiole breaks.
//!
//! Its break is drawn afresh every few steps: a random word against the chance that its strength, the season and the
//! speed of the air leave it (see `compile/foliage.rs`). The load of its own inertia is left out: at the few m/s²
//! of a swaying twig a leaf of half a gram pulls with some thousandths of a newton, a tenth of what the wind does.

use super::petiole::{
    Petiole, SHED_CLASSES, SHED_INTERVAL, SHED_SPEEDS, petiole_cluster, petiole_kind, petiole_length,
    petiole_strength,
};
use super::record::{
    Attitude, Drift, HALF_MASK, Place, STATE_ATTACHED, STATE_RESTING, Schedule, body_spin_words, drawn_size,
    leaf_state, lies, smoothed_air_speed, smoothed_air_speed_word, twig_sizes, with_blend, with_state,
};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal, sin_cos_turns};
use crate::arith::quaternion::{
    Quat, quat_multiply, quat_of_turn, quat_renormalize, quat_rotate, quat_rotate_back,
};
use crate::arith::rng::philox;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::blocks::{NEVER, SOURCE_TREES};
use crate::context::Context;
use crate::device::tree::sway::Body;
use crate::device::wind::sample::wind_at;
use crate::leaf::LeafMut;

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
    /// Smoothing factor of the air speed: share of a new sample.
    pub const AIR_SPEED_SMOOTHING: f32 = 0.25;
}

/// The hot records of a leaf on a twig.
#[derive(Debug)]
pub struct CarriedLeaf<'a> {
    /// Position and flags.
    pub place: &'a mut Place,
    /// Residual velocity and phase.
    pub drift: &'a mut Drift,
    /// Orientation.
    pub attitude: &'a mut Attitude,
    /// Next event.
    pub schedule: &'a mut Schedule,
}

impl<'a> From<LeafMut<'a>> for CarriedLeaf<'a> {
    fn from(leaf: LeafMut<'a>) -> Self {
        Self { place: leaf.place, drift: leaf.drift, attitude: leaf.attitude, schedule: leaf.schedule }
    }
}

impl CarriedLeaf<'_> {
    /// Moves the leaf there.
    pub fn set_pose(&mut self, pose: &TwigPose) {
        self.place.position = pose.position.to_array();
        self.attitude.quaternion = pose.attitude.to_array();
        self.drift.velocity = pose.velocity.to_array();
    }
}

/// Constants of a petiole that a step needs, of one leaf or lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct PetioleLanes<W: Word = u32> {
    /// Base in the frame of its segment in m.
    pub base: Vec3<W::Real>,
    /// Orientation of the leaf in the frame of its segment, in still air.
    pub rest: Quat<W::Real>,
    /// As in [`Petiole::bits`].
    pub bits: W,
}

impl From<&Petiole> for PetioleLanes {
    fn from(petiole: &Petiole) -> Self {
        Self { base: petiole.base.into(), rest: petiole.rest_quaternion.into(), bits: petiole.bits }
    }
}

/// Chance, of 2^32, that a petiole breaks in air of that speed at one of its samples.
#[inline(always)]
pub fn shed_chance<W: Word>(cx: &Context<'_>, bits: W, speed: W::Real) -> W {
    let most = bits.all(SHED_SPEEDS - 1);
    let whole = speed.floor().to_whole();
    let level = whole.less_than(most).select(whole, most);
    let of_kind = petiole_kind(bits).times(bits.all(SHED_CLASSES)).plus(petiole_strength(bits));
    let index = of_kind.times(bits.all(SHED_SPEEDS)).plus(level);
    let rows = &cx.tables[cx.scene.first_shed_row as usize..];
    let [a, b, c, d] = (index >> 2).look_up_words(bytemuck::cast_slice(rows));
    let low = (index & 1).equals(0).select(a, b);
    let high = (index & 1).equals(0).select(c, d);
    (index & 2).equals(0).select(low, high)
}

/// Pose of a leaf on its twig.
#[derive(Clone, Copy, Debug)]
pub struct TwigPose<R = f32> {
    /// Centre of its blade in m.
    pub position: Vec3<R>,
    /// Orientation.
    pub attitude: Quat<R>,
    /// Velocity of the blade in m/s.
    pub velocity: Vec3<R>,
}

/// Pose of a leaf on its segment in air of the smoothed speed `air_speed` in m/s.
#[inline(always)]
pub fn leaf_twig_pose<W: Word>(
    cx: &Context<'_>,
    air_speed: W::Real,
    slot: W,
    petiole: &PetioleLanes<W>,
    segment: &Body<W::Real>,
) -> TwigPose<W::Real> {
    let along = Vec3::new(0.0, 0.0, 1.0).spread(air_speed);
    let still = quat_multiply(segment.pose, petiole.rest);
    let tip = quat_rotate(still, along);
    let side = quat_rotate(still, Vec3::new(1.0, 0.0, 0.0).spread(air_speed));
    let mean = &cx.scene.wind;
    let wind = Vec3::new(mean.direction_x, 0.0, mean.direction_z).spread(air_speed);
    let share = air_speed * reciprocal(air_speed + LEAN_SPEED);
    let unrest = share * share;
    let rate = cx.scene.flutter_per_step;
    let own_rate = slot.all(rate).plus(slot.all(rate >> 5).times(slot & 15));
    let phase = own_rate.times(slot.all(cx.step.index)).plus(slot.times(slot.all(0x9E37_79B9)));
    let (roll, _) = sin_cos_turns(phase);
    let (_, pitch) = sin_cos_turns(phase << 1);
    let lean = vec3_cross(tip, wind) * (share * LEAN_MOST);
    let flutter = tip * ((unrest * FLUTTER_ROLL) * roll) + side * ((unrest * FLUTTER_PITCH) * pitch);
    let attitude = quat_renormalize(quat_multiply(quat_of_turn(lean + flutter), still));
    let blade = Vec3::new(air_speed.all(0.0), air_speed.all(0.0), petiole_length(petiole.bits));
    let arm = quat_rotate(segment.pose, petiole.base) + quat_rotate(attitude, blade);
    TwigPose {
        position: segment.base + arm,
        attitude,
        velocity: segment.velocity + vec3_cross(segment.spin, arm),
    }
}

/// Size of a leaf on its twig: its own in the high half, as it is drawn in the low one.
#[inline(always)]
pub fn leaf_size_on_twig(size: u32, bits: u32) -> u32 {
    twig_sizes(size, ((size * petiole_cluster(bits)) >> 4).min(HALF_MASK))
}

/// Lets a leaf that lies on the ground grow back once its time has come. Returns the change of the number of leaves on the
/// segment.
#[inline(always)]
pub fn leaf_return(cx: &Context<'_>, leaf: &mut CarriedLeaf<'_>, bits: u32) -> u32 {
    let is_back = leaf_state(leaf.place.bits) == STATE_RESTING
        && cx.scene.sources[SOURCE_TREES as usize].lifetime_steps != 0
        && cx.step.index >= leaf.schedule.event
        && !lies(leaf.place.bits);
    if !is_back {
        return 0;
    }
    leaf.place.bits = with_state(with_blend(leaf.place.bits, 0), STATE_ATTACHED);
    leaf.schedule.event = NEVER;
    leaf.schedule.size = leaf_size_on_twig(drawn_size(leaf.schedule.size), bits);
    leaf.drift.phase = 0;
    1
}

/// Returns true if a leaf hangs.
#[inline(always)]
pub fn leaf_hangs<W: Word>(cx: &Context<'_>, bits: W, event: W) -> W::Mask {
    leaf_state(bits).equals(STATE_ATTACHED) & bits.all(cx.step.index).less_than(event)
}

/// Number of slots from `slot` to the next petiole that samples the wind in this step.
#[inline(always)]
pub fn leaf_next_sample(cx: &Context<'_>, slot: u32) -> u32 {
    0u32.wrapping_sub(cx.step.index.wrapping_add(slot)) & (SHED_INTERVAL - 1)
}

/// Samples the wind at a petiole. Returns the smoothed speed of the air in m/s and true if the petiole breaks.
#[inline(always)]
pub fn leaf_sample_air<W: Word>(
    cx: &Context<'_>,
    air_speed: W::Real,
    slot: W,
    petiole: &PetioleLanes<W>,
    segment: &Body<W::Real>,
) -> (W::Real, W::Mask) {
    let arm = quat_rotate(segment.pose, petiole.base);
    let velocity = segment.velocity + vec3_cross(segment.spin, arm);
    let relative = wind_at(cx, segment.base + arm) - velocity;
    let squared = vec3_dot(relative, relative);
    let speed = squared * inverse_sqrt(squared.max(squared.all(TINY_SQUARED)));
    let seed = cx.scene.seed;
    let counter = [slot, slot.all(STREAM_SHED), slot.all(cx.step.index), slot.all(0)];
    let breaks = philox(seed, counter)[0].less_than(shed_chance(cx, petiole.bits, speed));
    (air_speed + (speed - air_speed) * AIR_SPEED_SMOOTHING, breaks)
}

/// A leaf that hangs goes where its segment went. If its petiole has broken in this step and it is to fly as a body, it
/// takes the segment's spin along.
#[inline(always)]
pub fn leaf_follow(
    cx: &Context<'_>,
    leaf: &mut CarriedLeaf<'_>,
    slot: u32,
    petiole: &PetioleLanes,
    segment: &Body,
) {
    let pose = leaf_twig_pose(cx, smoothed_air_speed(leaf.drift.phase), slot, petiole, segment);
    leaf.set_pose(&pose);
    if leaf.schedule.event == cx.step.index + 1 {
        let spin = quat_rotate_back(pose.attitude, segment.spin);
        [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(spin);
    }
}

/// One step of the leaf in a slot of a tree, after its segment has moved. Returns the change of the number of leaves on the
/// segment, in two's complement.
#[inline(always)]
pub fn leaf_carry(
    cx: &Context<'_>,
    leaf: &mut CarriedLeaf<'_>,
    slot: u32,
    petiole: &PetioleLanes,
    segment: &Body,
) -> u32 {
    let mut change = leaf_return(cx, leaf, petiole.bits);
    if !leaf_hangs(cx, leaf.place.bits, leaf.schedule.event) {
        return change;
    }
    if leaf_next_sample(cx, slot) == 0 {
        let (air_speed, breaks) =
            leaf_sample_air(cx, smoothed_air_speed(leaf.drift.phase), slot, petiole, segment);
        leaf.drift.phase = smoothed_air_speed_word(air_speed);
        if breaks {
            leaf.schedule.event = cx.step.index + 1;
            change = change.wrapping_sub(1);
        }
    }
    leaf_follow(cx, leaf, slot, petiole, segment);
    change
}
