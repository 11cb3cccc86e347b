// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/carry.wgsl
//!
//! Moves the leaves of trees with their twigs, and lets petioles break.

use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::carry::{leaf_carry, petiole_of};
use windfall_core::tree::record::NO_SEGMENT;
use windfall_core::tree::sway::row::Rows;

/// The leaves of a stand, whose first slot is `first`.
pub(crate) fn carry(cx: &Context<'_>, rows: &mut Rows<'_>, leaves: &mut LeavesMut<'_>, first: u32) {
    for (slot, leaf) in (first..).zip(leaves.iter_mut()) {
        let petiole = petiole_of(cx, slot);
        if petiole.segment == NO_SEGMENT {
            continue;
        }
        let row = (petiole.segment - rows.first) as usize;
        let change = leaf_carry(cx, &mut leaf.into(), slot, &petiole, &rows.body(row));
        let bearing = &mut rows.branches.bearing[row];
        *bearing = bearing.wrapping_add(change);
    }
}
