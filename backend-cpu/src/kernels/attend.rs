// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/attend.wgsl
//!
//! Moves the leaves through one step to which something happens in it.

use windfall_core::Context;
use windfall_core::kernel::lane::LANES;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::advance::leaf_advance;

use super::CHUNK;

/// The leaves of a chunk that `advance` has left alone: a bit for each, a byte for eight.
pub(crate) struct Attend {
    pub(crate) lanes: [u8; CHUNK / LANES],
}

impl Default for Attend {
    fn default() -> Self {
        Self { lanes: [0; CHUNK / LANES] }
    }
}

/// Steps the leaves of a chunk that are due, that land, or that have just landed.
pub(crate) fn attend(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, due: &Attend) {
    for (group, &lanes) in due.lanes.iter().enumerate() {
        let mut left = lanes;
        while left != 0 {
            let slot = group * LANES + left.trailing_zeros() as usize;
            leaf_advance(cx, &mut leaves.row_mut(slot));
            left &= left - 1;
        }
    }
}
