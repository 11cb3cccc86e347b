// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/resolve_events.wgsl
//!
//! Moves the listed leaves through one step with an event in it.

use windfall_core::Context;
use windfall_core::arith::pack::BLOCK;
use windfall_core::device::leaf::advance::leaf_advance;
use windfall_core::device::leaf::stack::leaf_changes_litter;
use windfall_core::leaf::LeavesMut;

use super::CHUNK;
use crate::quiet::UNIT;

/// Result of `advance` for a chunk.
pub(crate) struct EventList {
    /// Leaves that it has left alone: a bit for each, the first of a block in the lowest place.
    pub(crate) blocks: [u32; CHUNK / BLOCK],
    /// Units of slots that it has not passed by.
    pub(crate) is_stepped: [bool; CHUNK / UNIT],
}

impl Default for EventList {
    fn default() -> Self {
        Self { blocks: [0; CHUNK / BLOCK], is_stepped: [false; CHUNK / UNIT] }
    }
}

impl EventList {
    /// Numbers of the units that have been stepped.
    pub(crate) fn stepped(&self) -> impl Iterator<Item = usize> {
        (0..).zip(self.is_stepped).filter_map(|(unit, is_stepped)| is_stepped.then_some(unit))
    }
}

/// Steps the leaves of a chunk that have an event, that land, or that have just landed. Lists those that wait for the litter to change.
pub(crate) fn resolve_events(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    events: &EventList,
    changing: &mut Vec<usize>,
) {
    let blocks_of = |unit: usize| unit * (UNIT / BLOCK)..(unit + 1) * (UNIT / BLOCK);
    for block in events.stepped().flat_map(blocks_of) {
        let mut left = events.blocks[block];
        while left != 0 {
            let slot = block * BLOCK + left.trailing_zeros() as usize;
            leaf_advance(cx, &mut leaves.row_mut(slot));
            if leaf_changes_litter(leaves.place[slot].bits, leaves.drift[slot].velocity.into()) {
                changing.push(slot);
            }
            left &= left - 1;
        }
    }
}
