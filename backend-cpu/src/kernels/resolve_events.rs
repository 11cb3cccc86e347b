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
use crate::quiet::{UNIT, places_of};

/// Bits of a block of a unit.
#[expect(clippy::cast_possible_truncation, reason = "as many bits as a block has leaves")]
#[inline(always)]
pub(crate) fn bits_of_block(of_unit: u64, block: usize) -> u32 {
    (of_unit >> (block * BLOCK)) as u32 & ((1 << BLOCK) - 1)
}

/// Result of `advance` for a chunk.
pub(crate) struct EventList {
    /// Leaves that it has left alone: a bit for each, the first of a block in the lowest place.
    pub(crate) blocks: [u32; CHUNK / BLOCK],
    /// Leaves of units of slots that are on their way, or may be: a bit for each.
    pub(crate) stirring: [u64; CHUNK / UNIT],
}

impl Default for EventList {
    fn default() -> Self {
        Self { blocks: [0; CHUNK / BLOCK], stirring: [0; CHUNK / UNIT] }
    }
}

impl EventList {
    /// Numbers of the blocks of slots with leaves on their way, and a bit for each of these.
    #[inline(always)]
    pub(crate) fn stirring_blocks(&self) -> impl Iterator<Item = (usize, u32)> {
        let blocks =
            self.stirring.into_iter().enumerate().filter(|&(_, bits)| bits != 0).flat_map(|(unit, bits)| {
                (0..UNIT / BLOCK)
                    .map(move |block| (unit * (UNIT / BLOCK) + block, bits_of_block(bits, block)))
            });
        blocks.filter(|&(_, bits)| bits != 0)
    }
}

/// Steps the leaves of a chunk that have an event, that land, or that have just landed. Lists those that wait for the litter to change.
pub(crate) fn resolve_events(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    events: &EventList,
    changing: &mut Vec<usize>,
) {
    for (block, _) in events.stirring_blocks() {
        for place in places_of(events.blocks[block].into()) {
            let slot = block * BLOCK + place;
            leaf_advance(cx, &mut leaves.row_mut(slot));
            if leaf_changes_litter(leaves.place[slot].bits, leaves.drift[slot].velocity.into()) {
                changing.push(slot);
            }
        }
    }
}
