// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/collide.wgsl
//!
//! Lets leaves that fly as bodies collide with the others of their cells.

use windfall_core::Context;
use windfall_core::device::leaf::collide::{collision_cell, leaf_collide};
use windfall_core::device::leaf::record::flies;
use windfall_core::leaf::LeavesMut;

use crate::cell_sums::CollisionCells;
use crate::quiet::{QuietUnit, stirring_slots};

/// Lets the bodies of a chunk collide.
pub(crate) fn collide(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[QuietUnit],
    cells: &CollisionCells,
) {
    for slot in stirring_slots(quiet, cx.step.index, leaves.len()) {
        let place = leaves.place[slot];
        if flies(place.bits) {
            let cell = collision_cell(cx, place.position.into());
            leaf_collide(cx, &mut leaves.row_mut(slot), &cell, &cells.sums(cell.index));
        }
    }
}
