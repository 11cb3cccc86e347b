// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/afloat.wgsl
//!
//! Leaves on water: they drift before the wind, along the shore, up to other leaves; soaked, they sink to the ground beneath.
//!
//! Where a leaf may go in a step is decided from the heights at its start. It goes there at its end, with its volume
//! ([`leaf_stack`](super::stack::leaf_stack)).

use super::lie::STREAM_LYING;
use super::record::{asymmetry, is_afloat, lying_support_word, soaked_bits, wake_speed_word, with_afloat};
use super::stack::drifted;
use super::strike::is_inside_solid;
use super::wake::layers_above;
use crate::arith::math::inverse_sqrt;
use crate::arith::quaternion::{Quat, quat_multiply, quat_normalize};
use crate::arith::rng::{mul_high, random, unit_float};
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::flight::body::body_of;
use crate::device::leaf::at_rest::{LEAST_WAKES, NEVER_WAKES};
use crate::device::terrain::ground::{ground_bottom, ground_is_water, ground_rise};
use crate::device::terrain::litter::{LITTER_CELLS_PER_M, litter_cell, litter_height};
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Height in m above the water at which the wind at a leaf afloat is sampled.
    pub const FLOAT_WIND_M: f32 = 0.1;
    /// Squared speed in m²/s² below which a leaf afloat lies still.
    pub const STILL_SQUARED: f32 = 1e-8;
    /// Layers of leaves half a cell ahead from which on a leaf afloat does not go there.
    pub const RAFT_LAYERS: f32 = 1.0;
    /// Layers by which there may be more where it is for it to go there nevertheless.
    pub const RAFT_DROP: f32 = 0.75;
    /// Largest angle in rad by which a leaf turns for each metre that it drifts.
    pub const TURN_RAD_PER_M: f32 = 0.6;
    /// Least speed of sinking in m/s.
    pub const SINKING_M_S: f32 = 0.005;
    /// Largest speed of sinking beyond that.
    pub const SINKING_SPREAD_M_S: f32 = 0.015;
}

/// Returns true if leaves float at a place: on water, where litter may lie.
#[inline(always)]
pub fn floats_at(cx: &Context<'_>, x: f32, z: f32) -> bool {
    cx.scene.leaves_float() && litter_cell(cx, x, z).bears && ground_is_water(cx, x, z)
}

/// Steps for which a leaf floats, by its own words: half of the scene's to one and a half times.
#[inline(always)]
pub fn soaking_steps(cx: &Context<'_>, words: [u32; 4]) -> u32 {
    let steps = cx.scene.litter.soaking_steps;
    (steps >> 1) + mul_high(words[3], steps) + 1
}

/// Speed in m/s at which a leaf sinks, by its own words.
#[inline(always)]
pub fn sinking_speed(words: [u32; 4]) -> f32 {
    SINKING_M_S + SINKING_SPREAD_M_S * unit_float(words[3] << 16)
}

/// Sets a leaf afloat that has just lain down on water, until it is soaked.
#[inline(always)]
pub fn leaf_set_afloat(cx: &Context<'_>, leaf: &mut LeafMut<'_>, words: [u32; 4]) {
    leaf.place.bits = with_afloat(leaf.place.bits);
    leaf.schedule.event = leaf.schedule.event.min(cx.step.index.saturating_add(soaking_steps(cx, words)));
    leaf.drift.phase = wake_speed_word(LEAST_WAKES);
    leaf.schedule.rate = lying_support_word(FLOAT_WIND_M);
}

/// The part of a velocity along the shore, where that rises ahead.
#[inline(always)]
pub fn along_shore(cx: &Context<'_>, place: Vec3, velocity: Vec3) -> Vec3 {
    let [rise_x, rise_z] = ground_rise(cx, place.x, place.z);
    let steep = rise_x * rise_x + rise_z * rise_z;
    let inverse = inverse_sqrt(steep.max(STILL_SQUARED));
    let (x, z) = (rise_x * inverse, rise_z * inverse);
    let landward = (velocity.x * x + velocity.z * z).max(0.0);
    Vec3::new(velocity.x - x * landward, 0.0, velocity.z - z * landward)
}

/// Returns true if there are so many leaves half a cell ahead of a leaf afloat, in a direction, that it does not go there.
#[inline(always)]
pub fn raft_is_ahead(cx: &Context<'_>, bits: u32, place: Vec3, direction: Vec3) -> bool {
    let reach = 0.5 / LITTER_CELLS_PER_M;
    let ahead = litter_height(cx, place.x + direction.x * reach, place.z + direction.z * reach);
    let here = litter_height(cx, place.x, place.z);
    RAFT_LAYERS < layers_above(cx, bits, ahead) && layers_above(cx, bits, here - ahead) < RAFT_DROP
}

/// Velocity with which a leaf afloat drifts in this step that would go with another: along the shore, up to rafts and solid parts.
#[inline(always)]
pub fn drifting_velocity(cx: &Context<'_>, leaf: &LeafMut<'_>, velocity: Vec3) -> Vec3 {
    let place = Vec3::from(leaf.place.position);
    let mut way = velocity;
    let free = drifted(cx, place, way);
    if !floats_at(cx, free.x, free.z) {
        way = along_shore(cx, place, way);
    }
    let next = drifted(cx, place, way);
    let squared = way.x * way.x + way.z * way.z;
    if squared < STILL_SQUARED || !floats_at(cx, next.x, next.z) {
        return Vec3::ZERO;
    }
    if raft_is_ahead(cx, leaf.place.bits, place, way * inverse_sqrt(squared)) {
        return Vec3::ZERO;
    }
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    if is_inside_solid(cx, &body, leaf.attitude.quaternion.into(), next) {
        return Vec3::ZERO;
    }
    way
}

/// Lets the wind at a leaf afloat, and the water that it moves, take the leaf along. Returns true if that sets it in motion.
#[inline(always)]
pub fn leaf_float(cx: &Context<'_>, leaf: &mut LeafMut<'_>, wind: Vec3) -> bool {
    let litter = &cx.scene.litter;
    let [x, _, z] = leaf.drift.velocity;
    let toward = |now: f32, wind: f32| {
        let drift = wind * litter.drift_share;
        drift + (now - drift) * litter.drift_kept
    };
    let way = drifting_velocity(cx, leaf, Vec3::new(toward(x, wind.x), 0.0, toward(z, wind.z)));
    leaf.drift.velocity = way.to_array();
    x == 0.0 && z == 0.0 && (way.x != 0.0 || way.z != 0.0)
}

/// One step of a leaf that drifts on water or sinks in it.
#[inline(always)]
pub fn leaf_drift(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if is_afloat(leaf.place.bits) {
        let came = Vec3::from(leaf.drift.velocity);
        let way = if cx.scene.is_calm() { Vec3::ZERO } else { drifting_velocity(cx, leaf, came) };
        leaf.drift.velocity = way.to_array();
        let squared = (way.x * way.x + way.z * way.z).max(STILL_SQUARED);
        let way_m = (squared * inverse_sqrt(squared)) * cx.scene.dt_s;
        let half = (asymmetry(leaf.schedule.size, 0) * (0.5 * TURN_RAD_PER_M)) * way_m;
        let turned = quat_multiply(Quat::new(0.0, half, 0.0, 1.0), leaf.attitude.quaternion.into());
        leaf.attitude.quaternion = quat_normalize(turned).to_array();
        return;
    }
    let [x, y, z] = leaf.place.position;
    let bottom = ground_bottom(cx, x, z);
    let next = y + leaf.drift.velocity[1] * cx.scene.dt_s;
    leaf.place.position[1] = next.max(bottom);
    if next <= bottom {
        leaf.drift.velocity[1] = 0.0;
        leaf.drift.phase = wake_speed_word(NEVER_WAKES);
    }
}

/// Lets a leaf afloat that is soaked sink.
#[inline(always)]
pub fn leaf_soak(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let words = random(cx.scene.seed, leaf.identity.id, STREAM_LYING);
    leaf.place.bits = soaked_bits(leaf.place.bits);
    leaf.drift.velocity = [0.0, -sinking_speed(words), 0.0];
}
