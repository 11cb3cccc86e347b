// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps all leaves, chunk by chunk: the kernels [`advance`], [`resolve_events`] and [`fly`] while a chunk is in the cache, for
//! several steps in a row. That changes nothing, as leaves do not see each other; where there is litter, which they see, it is one
//! step, in which no height changes.

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;

use super::CHUNK;
use super::advance::advance;
use super::check_cover::check_cover;
use super::fly::fly;
use super::push_lying::push_lying;
use super::resolve_events::resolve_events;
use super::stack_litter::LitterChanges;
use super::wake_lying::wake_lying;
use crate::exposed::ExposedLeaves;
use crate::quiet::{QuietUnit, UNIT, are_quiet};
use crate::simd::Simd;

/// Largest piece that is asked whether it is quiet as a whole, before it is split among threads.
const LARGEST_REST: usize = 64 * CHUNK;

/// A run of steps, as all chunks share it.
pub(crate) struct LeafSteps<'a> {
    /// A view for each step.
    pub(crate) steps: &'a [Context<'a>],
    pub(crate) changes: &'a LitterChanges,
    pub(crate) exposed: &'a ExposedLeaves,
    pub(crate) simd: Simd,
}

/// Steps leaves from slot `first` on, halving the columns until a piece is one chunk. There is an entry for each unit of slots.
pub(crate) fn step_leaves(all: &LeafSteps<'_>, mut leaves: LeavesMut<'_>, quiet: &[QuietUnit], first: usize) {
    let LeafSteps { steps, changes, exposed, simd } = *all;
    let last = steps.last().map_or(0, |cx| cx.step.index);
    let has_litter = steps.iter().any(Context::has_litter);
    if !has_litter && leaves.len() <= LARGEST_REST && are_quiet(quiet, last) {
        return;
    }
    if leaves.len() > CHUNK {
        let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
        let (front, back) = leaves.split_at(middle);
        let (front_quiet, back_quiet) = quiet.split_at(middle / UNIT);
        join(
            || step_leaves(all, front, front_quiet, first),
            || step_leaves(all, back, back_quiet, first + middle),
        );
        return;
    }
    for cx in steps {
        let mut changing = Vec::new();
        // Without litter that has been asked before, for all steps together.
        if !has_litter || !are_quiet(quiet, cx.step.index) {
            let events = advance(cx, &mut leaves, quiet, simd);
            resolve_events(cx, &mut leaves, &events, &mut changing);
            if cx.scene.has_bodies() {
                fly(cx, &mut leaves, &events, simd);
            }
        }
        if cx.scene.has_living_litter() {
            if cx.scene.has_movers() {
                push_lying(cx, &mut leaves, &mut changing, simd);
            }
            check_cover(cx, &mut leaves, first, exposed, &mut changing, simd);
            if !cx.scene.is_calm() {
                wake_lying(cx, &mut leaves, first, exposed, &mut changing, simd);
            }
            changes.list(&changing, first);
        }
    }
}
