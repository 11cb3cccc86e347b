// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/stack.wgsl
//!
//! The end of a step in the litter: leaves that have lain down in it give it their volume, those that leave it take the same back.

use super::record::{
    AERODYNAMIC, CHANGE_ADDED, CHANGE_NONE, CHANGE_WOKEN, STATE_FALLING, STATE_RESTING, leaf_species, lies,
    litter_change, lying_volume, place_bits, with_litter_change,
};
use crate::context::Context;
use crate::device::terrain::litter::{LitterShares, litter_shares};
use crate::leaf::LeafMut;

/// Change of the heights of litter by a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LitterChange {
    /// Nodes and heights.
    pub shares: LitterShares,
    /// True if the heights are added, false if they are taken away.
    pub is_added: bool,
    /// True if the wind has taken the leaf.
    pub is_woken: bool,
}

/// Returns true if a leaf waits for the litter to change.
#[inline(always)]
pub fn leaf_changes_litter(bits: u32) -> bool {
    lies(bits) && litter_change(bits) != CHANGE_NONE
}

/// Ends the waiting of a leaf: it lies, flies or settles anew. Returns the change that the litter is to make.
#[inline(always)]
pub fn leaf_stack(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> LitterChange {
    let bits = leaf.place.bits;
    let change = litter_change(bits);
    let [x, _, z] = leaf.place.position;
    let shares = litter_shares(cx, lying_volume(bits), x, z);
    let species = leaf_species(bits);
    if change == CHANGE_ADDED {
        leaf.place.bits = with_litter_change(bits, CHANGE_NONE);
    } else if change == CHANGE_WOKEN {
        leaf.place.bits = place_bits(STATE_FALLING, 0, AERODYNAMIC, species, 0);
        leaf.identity.fall_time = 0;
    } else {
        leaf.place.bits = place_bits(STATE_RESTING, 0, 0, species, 0);
        leaf.drift.phase = 0;
        leaf.schedule.rate = 0;
        leaf.schedule.heading = 0;
    }
    LitterChange { shares, is_added: change == CHANGE_ADDED, is_woken: change == CHANGE_WOKEN }
}
