// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/collide.wgsl
//!
//! Lets leaves that fly as bodies collide with the others of their cells.

use windfall_core::Context;
use windfall_core::device::leaf::collide::{collision_cell, leaf_collide};
use windfall_core::device::leaf::record::flies;
use windfall_core::leaf::LeavesMut;

use super::gather_collisions::BATCH;
use crate::cell_sums::CollisionCells;
use crate::quiet::{QuietUnit, stirring_slots};

/// Lets the bodies of a chunk collide.
pub(crate) fn collide(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &[QuietUnit],
    cells: &CollisionCells,
) {
    let mut slots = stirring_slots(quiet, cx.step.index, leaves.len());
    let mut batch = Vec::with_capacity(BATCH);
    loop {
        batch.clear();
        let flying = slots.by_ref().filter(|&slot| flies(leaves.place[slot].bits));
        batch.extend(
            flying.map(|slot| (slot, collision_cell(cx, leaves.place[slot].position.into()))).take(BATCH),
        );
        if batch.is_empty() {
            break;
        }
        cells.fetch(batch.iter().map(|(_, cell)| cell.index));
        for (slot, cell) in &batch {
            leaf_collide(cx, &mut leaves.row_mut(*slot), cell, &cells.sums(cell.index));
        }
    }
}
