// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/stack.wgsl
//!
//! The end of a step in the litter: leaves that have lain down in it give it their volume, those that leave it take the same back, and
//! those that drift on water do both.

use super::record::{
    AERODYNAMIC, CHANGE_ADDED, CHANGE_NONE, CHANGE_REMOVED, CHANGE_WOKEN, STATE_FALLING, STATE_RESTING,
    is_afloat, is_sunk, leaf_species, lies, litter_change, lying_volume, place_bits, sunk_bits,
    with_litter_change,
};
use super::settle::recycling_step;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::terrain::litter::{LitterShares, litter_shares};
use crate::leaf::LeafMut;

/// Change of the heights of litter by a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LitterChange {
    /// Heights that are taken away.
    pub taken: LitterShares,
    /// Heights that are added.
    pub added: LitterShares,
    /// True if the leaf comes to lie.
    pub lies: bool,
    /// True if the wind has taken the leaf.
    pub is_woken: bool,
}

/// Returns true if a leaf with these bits and this velocity waits for the litter to change.
#[inline(always)]
pub fn leaf_changes_litter(bits: u32, velocity: Vec3) -> bool {
    let drifts = is_afloat(bits) && (velocity.x != 0.0 || velocity.z != 0.0);
    lies(bits) && (litter_change(bits) != CHANGE_NONE || drifts)
}

/// Place of a leaf afloat after a step.
#[inline(always)]
pub fn drifted(cx: &Context<'_>, place: Vec3, velocity: Vec3) -> Vec3 {
    Vec3::new(place.x + velocity.x * cx.scene.dt_s, place.y, place.z + velocity.z * cx.scene.dt_s)
}

/// Ends the waiting of a leaf: it lies, flies, settles anew, drifts on or sinks. Returns the change that the litter is to make.
#[inline(always)]
pub fn leaf_stack(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> LitterChange {
    let bits = leaf.place.bits;
    let change = litter_change(bits);
    let place = Vec3::from(leaf.place.position);
    let here = litter_shares(cx, lying_volume(bits), place.x, place.z);
    let none = LitterShares { node: here.node, heights: [0; 4] };
    let species = leaf_species(bits);
    let taken = if change == CHANGE_ADDED { none } else { here };
    let mut added = if change == CHANGE_ADDED { here } else { none };
    if is_afloat(bits) && (change == CHANGE_WOKEN || change == CHANGE_REMOVED) {
        leaf.schedule.event = recycling_step(cx, leaf.identity);
    }
    if change == CHANGE_ADDED {
        leaf.place.bits = with_litter_change(bits, CHANGE_NONE);
    } else if change == CHANGE_WOKEN {
        leaf.place.bits = place_bits(STATE_FALLING, 0, AERODYNAMIC, species, 0);
        leaf.identity.fall_time = 0;
    } else if change == CHANGE_NONE {
        let next = drifted(cx, place, leaf.drift.velocity.into());
        added = litter_shares(cx, lying_volume(bits), next.x, next.z);
        leaf.place.position = next.to_array();
    } else {
        let sinks = is_afloat(bits) && is_sunk(bits);
        leaf.place.bits =
            if sinks { sunk_bits(species) } else { place_bits(STATE_RESTING, 0, 0, species, 0) };
        leaf.drift.phase = 0;
        leaf.schedule.rate = 0;
        leaf.schedule.heading = 0;
    }
    LitterChange { taken, added, lies: change == CHANGE_ADDED, is_woken: change == CHANGE_WOKEN }
}
