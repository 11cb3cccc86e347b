// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/resolve_events.wgsl
//!
//! Moves the listed leaves through one step with an event in it.

use windfall_core::Context;
use windfall_core::arith::lane::LANES;
use windfall_core::device::leaf::advance::leaf_advance;
use windfall_core::leaf::LeavesMut;

use super::CHUNK;

/// The leaves of a chunk that `advance` has left alone: a bit for each, a byte for eight.
pub(crate) struct EventList {
    pub(crate) lanes: [u8; CHUNK / LANES],
}

impl Default for EventList {
    fn default() -> Self {
        Self { lanes: [0; CHUNK / LANES] }
    }
}

/// Steps the leaves of a chunk that have an event, that land, or that have just landed.
pub(crate) fn resolve_events(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList) {
    for (group, &lanes) in events.lanes.iter().enumerate() {
        let mut left = lanes;
        while left != 0 {
            let slot = group * LANES + left.trailing_zeros() as usize;
            leaf_advance(cx, &mut leaves.row_mut(slot));
            left &= left - 1;
        }
    }
}
