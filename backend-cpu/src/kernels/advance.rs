// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf through one step to which nothing happens in it, and leaves the others to `attend`.

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::advance::{leaf_advance_plain, leaf_is_due};

use super::CHUNK;
use super::attend::attend;

/// Steps all leaves, halving the columns until a piece is one chunk.
pub(crate) fn advance(cx: &Context<'_>, mut leaves: LeavesMut<'_>) {
    if leaves.len() <= CHUNK {
        for mut leaf in leaves.iter_mut() {
            if !leaf_is_due(cx, &leaf) {
                leaf_advance_plain(cx, &mut leaf);
            }
        }
        attend(cx, &mut leaves);
        return;
    }
    let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
    let (front, back) = leaves.split_at(middle);
    join(|| advance(cx, front), || advance(cx, back));
}
