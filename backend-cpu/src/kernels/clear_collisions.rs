// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/clear_collisions.wgsl
//!
//! Clears the cells of the air that leaves have been added to.

use crate::cell_sums::CollisionCells;

/// Clears them.
pub(crate) fn clear_collisions(cells: &CollisionCells) {
    cells.clear();
}
