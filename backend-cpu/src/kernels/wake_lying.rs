// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/wake_lying.wgsl
//!
//! Samples the wind at the leaves of a chunk that lie in the litter, for the units that have their turn.

use windfall_core::Context;
use windfall_core::device::leaf::record::{is_covered, lies};
use windfall_core::device::leaf::wake::{cover_is_due, leaf_check_cover, leaf_wake, wake_is_due};
use windfall_core::leaf::LeavesMut;

use crate::exposed::ExposedLeaves;
use crate::quiet::UNIT;
use crate::simd::branch_block::word;

/// Wakes leaves of a chunk that begins with slot `first`, and lists them.
pub(crate) fn wake_lying(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    first: usize,
    exposed: &ExposedLeaves,
    changing: &mut Vec<usize>,
) {
    for unit in (0..leaves.len()).step_by(UNIT).filter(|unit| wake_is_due(cx, word(first + unit))) {
        let slots = unit..leaves.len().min(unit + UNIT);
        if cover_is_due(cx, word(first + unit)) {
            for slot in slots.clone() {
                if leaf_check_cover(cx, &mut leaves.row_mut(slot)) {
                    changing.push(slot);
                }
            }
            let is_exposed = |slot: &usize| {
                let bits = leaves.place[*slot].bits;
                lies(bits) && !is_covered(bits)
            };
            exposed.set(first + unit, slots.filter(is_exposed).map(|slot| slot - unit));
        }
        for place in exposed.of_unit(first + unit) {
            let slot = unit + place;
            if slot < leaves.len() && leaf_wake(cx, &mut leaves.row_mut(slot)) {
                changing.push(slot);
            }
        }
    }
}
