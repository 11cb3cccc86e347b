// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf through one step.

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::advance::leaf_advance;

use super::CHUNK;

/// Steps all leaves, halving the columns until a piece is one chunk.
pub(crate) fn advance(cx: &Context<'_>, mut leaves: LeavesMut<'_>) {
    if leaves.len() <= CHUNK {
        for mut leaf in leaves.iter_mut() {
            leaf_advance(cx, &mut leaf);
        }
        return;
    }
    let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
    let (front, back) = leaves.split_at(middle);
    join(|| advance(cx, front), || advance(cx, back));
}
