// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/gather_collisions.wgsl
//!
//! Adds the leaves that fly as bodies to the cells of the air that they are in.

use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::device::leaf::collide::{collision_cell, own_sums};
use windfall_core::device::leaf::record::flies;
use windfall_core::leaf::LeavesMut;

use crate::cell_sums::CollisionCells;
use crate::quiet::{QuietUnit, stirring_slots};

/// Adds the bodies of a chunk.
pub(crate) fn gather_collisions(
    cx: &Context<'_>,
    leaves: &LeavesMut<'_>,
    quiet: &[QuietUnit],
    cells: &CollisionCells,
) {
    let mut touched = Vec::new();
    for slot in stirring_slots(quiet, cx.step.index, leaves.len()) {
        let place = leaves.place[slot];
        if flies(place.bits) {
            let cell = collision_cell(cx, place.position.into());
            let velocity = Vec3::from(leaves.drift[slot].velocity);
            let sums = own_sums(cx, &cell, place.bits, leaves.schedule[slot].size, velocity);
            if cells.add(cell.index, &sums) {
                touched.push(cell.index);
            }
        }
    }
    cells.list(&touched);
}
