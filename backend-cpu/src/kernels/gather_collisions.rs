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

/// Bodies whose cells are read at a time.
pub(super) const BATCH: usize = 16;

/// Adds the bodies of a chunk.
pub(crate) fn gather_collisions(
    cx: &Context<'_>,
    leaves: &LeavesMut<'_>,
    quiet: &[QuietUnit],
    cells: &CollisionCells,
) {
    let mut touched = Vec::new();
    let mut flying = stirring_slots(quiet, cx.step.index, leaves.len()).filter_map(|slot| {
        let place = leaves.place[slot];
        flies(place.bits).then(|| {
            let cell = collision_cell(cx, place.position.into());
            let velocity = Vec3::from(leaves.drift[slot].velocity);
            (cell.index, own_sums(cx, &cell, place.bits, leaves.schedule[slot].size, velocity))
        })
    });
    let mut batch = Vec::with_capacity(BATCH);
    loop {
        batch.clear();
        batch.extend(flying.by_ref().take(BATCH));
        if batch.is_empty() {
            break;
        }
        cells.fetch(batch.iter().map(|(index, _)| *index));
        let clear = batch.iter().filter(|(index, sums)| cells.add(*index, sums));
        touched.extend(clear.map(|(index, _)| *index));
    }
    cells.list(&touched);
}
