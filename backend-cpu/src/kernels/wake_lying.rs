// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/wake_lying.wgsl
//!
//! Samples the wind at the leaves of a chunk that lie in the litter, for the units that have their turn.

use windfall_core::Context;
use windfall_core::device::leaf::wake::{leaf_wake, wake_is_due};
use windfall_core::leaf::LeavesMut;

use crate::quiet::UNIT;
use crate::simd::branch_block::word;

/// Wakes leaves of a chunk that begins with slot `first`, and lists them.
pub(crate) fn wake_lying(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    first: usize,
    changing: &mut Vec<usize>,
) {
    for unit in (0..leaves.len()).step_by(UNIT) {
        if wake_is_due(cx, word(first + unit)) {
            for slot in unit..leaves.len().min(unit + UNIT) {
                if leaf_wake(cx, &mut leaves.row_mut(slot)) {
                    changing.push(slot);
                }
            }
        }
    }
}
