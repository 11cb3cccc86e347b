// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps all leaves, chunk by chunk: the kernels [`advance`], [`resolve_events`] and [`fly`] while a chunk is in the cache, for
//! several steps in a row. That changes nothing, as leaves do not see each other.

use std::sync::atomic::AtomicU32;

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;

use super::CHUNK;
use super::advance::advance;
use super::fly::fly;
use super::resolve_events::resolve_events;
use crate::quiet::{UNIT, are_quiet};
use crate::simd::Simd;

/// Largest piece that is asked whether it is quiet as a whole, before it is split among threads.
const LARGEST_REST: usize = 64 * CHUNK;

/// Steps all leaves, halving the columns until a piece is one chunk. There is a context for each step, and a word for
/// each unit of slots.
pub(crate) fn step_leaves(steps: &[Context<'_>], mut leaves: LeavesMut<'_>, quiet: &[AtomicU32], simd: Simd) {
    let last = steps.last().map_or(0, |cx| cx.step.index);
    if leaves.len() <= LARGEST_REST && are_quiet(quiet, last) {
        return;
    }
    if leaves.len() > CHUNK {
        let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = leaves.split_at(middle);
        let (front_quiet, back_quiet) = quiet.split_at(middle / UNIT);
        join(|| step_leaves(steps, front, front_quiet, simd), || step_leaves(steps, back, back_quiet, simd));
        return;
    }
    for cx in steps {
        let events = advance(cx, &mut leaves, quiet, simd);
        resolve_events(cx, &mut leaves, &events);
        if cx.scene.has_bodies() {
            fly(cx, &mut leaves, &events, simd);
        }
    }
}
