// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps all leaves, chunk by chunk: the kernels [`advance`], [`resolve_events`] and [`fly`] while a chunk is in the cache.

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;

use super::CHUNK;
use super::advance::advance;
use super::fly::fly;
use super::resolve_events::resolve_events;
use crate::simd::Simd;

/// Steps all leaves, halving the columns until a piece is one chunk.
pub(crate) fn step_leaves(cx: &Context<'_>, mut leaves: LeavesMut<'_>, simd: Simd) {
    if leaves.len() > CHUNK {
        let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = leaves.split_at(middle);
        join(|| step_leaves(cx, front, simd), || step_leaves(cx, back, simd));
        return;
    }
    let events = advance(cx, &mut leaves, simd);
    resolve_events(cx, &mut leaves, &events);
    if cx.scene.has_bodies() {
        fly(cx, &mut leaves, simd);
    }
}
