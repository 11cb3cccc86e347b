// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/burn_leaves.wgsl
//!
//! Heats leaves, and lets those that are lit burn on.

use rayon::join;
use windfall_core::Context;
use windfall_core::device::leaf::burn::{burn_cell, cell_power, leaf_burn};
use windfall_core::leaf::{BurnsMut, LeavesMut};

use super::CHUNK;
use super::stack_litter::LitterChanges;
use crate::heat_sums::HeatSums;
use crate::simd::branch_block::word;

/// Heats leaves from slot `first` on, and lists those that wait for the litter to change.
pub(crate) fn burn_leaves(
    cx: &Context<'_>,
    mut leaves: LeavesMut<'_>,
    mut burns: BurnsMut<'_>,
    first: usize,
    heat: &HeatSums,
    changes: &LitterChanges,
) {
    if leaves.len() > CHUNK {
        let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = leaves.split_at(middle);
        let (front_burns, back_burns) = burns.split_at(middle);
        join(
            || burn_leaves(cx, front, front_burns, first, heat, changes),
            || burn_leaves(cx, back, back_burns, first + middle, heat, changes),
        );
        return;
    }
    let mut changing = Vec::new();
    for slot in 0..leaves.len() {
        let cell = burn_cell(cx, leaves.place[slot].position.into());
        let power_w = cell_power(&cell, &heat.cells.sums(cell.index));
        let burn = burns.row_mut(slot).burn;
        if leaf_burn(cx, &mut leaves.row_mut(slot), word(first + slot), burn, power_w) {
            changing.push(slot);
        }
    }
    changes.list(&changing, first);
}
