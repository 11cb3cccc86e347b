// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/attend.wgsl
//!
//! Moves the leaves through one step to which something happens in it.

use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::advance::{leaf_advance_due, leaf_is_due};

/// Steps the leaves of a chunk that were due before it and that `advance` left alone. Nothing that `advance` does to
/// another leaf can make it due in the same step: its next event is later.
pub(crate) fn attend(cx: &Context<'_>, leaves: &mut LeavesMut<'_>) {
    for mut leaf in leaves.iter_mut() {
        if leaf_is_due(cx, &leaf) {
            leaf_advance_due(cx, &mut leaf);
        }
    }
}
