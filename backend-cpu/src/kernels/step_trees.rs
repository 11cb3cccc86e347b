// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps all trees with the leaves on them, batch by batch: the passes of a scheme and [`carry`] while a batch is in the cache.

use std::sync::{Mutex, PoisonError};

use rayon::{current_thread_index, join};
use windfall_core::Context;
use windfall_core::device::tree::sway::SCHEME_ARTICULATED;
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::leaf::LeavesMut;
use windfall_core::tree::batch::TreeBatch;
use windfall_core::tree::{BranchesMut, SegmentConstants};

use super::carry::{BatchLeaves, carry};
use super::sway_coast::sway_coast;
use super::sway_follow::sway_follow;
use super::sway_gather::sway_gather;
use super::sway_inward::sway_inward;
use super::sway_outward::sway_outward;
use crate::quiet::QuietUnits;
use crate::simd::Simd;
use crate::simd::batch_blocks::BatchBlocks;
use crate::simd::sway_scratch::{BlockScratch, Scratch};

/// Consecutive batches with all that belongs to them.
pub(crate) struct BatchRun<'a> {
    pub(crate) batches: &'a [TreeBatch],
    pub(crate) blocks: &'a [BatchBlocks],
    pub(crate) segments: &'a [SegmentConstants],
    pub(crate) branches: BranchesMut<'a>,
    pub(crate) leaves: LeavesMut<'a>,
    pub(crate) quiet: &'a QuietUnits,
}

/// Steps consecutive batches, halving them until a piece is one. There is a scratch for each thread.
pub(crate) fn step_trees(cx: &Context<'_>, run: BatchRun<'_>, scratches: &[Mutex<Scratch>], simd: Simd) {
    let BatchRun { batches, blocks, segments, branches, leaves, quiet } = run;
    let [first, .., last] = batches else {
        if let ([batch], [blocks]) = (batches, blocks) {
            // A thread of another pool may have a larger number; then it waits for the scratch of another.
            let own = current_thread_index().unwrap_or(0) % scratches.len();
            let mut scratch = scratches[own].lock().unwrap_or_else(PoisonError::into_inner);
            let Scratch { work, blocks: block_scratch } = &mut *scratch;
            let rows = Rows { first: batch.first, segments, branches, work };
            let leaves = BatchLeaves { leaves, first: batch.slots.start, quiet };
            step_batch(cx, blocks, rows, block_scratch, leaves, simd);
        }
        return;
    };
    let half = batches.len() / 2;
    let (front, back) = batches.split_at(half);
    let (front_blocks, back_blocks) = blocks.split_at(half);
    let rows = (back[0].first - first.first) as usize;
    let slots = (back[0].slots.start - first.slots.start) as usize;
    debug_assert_eq!(segments.len(), (last.first - first.first) as usize + last.len(), "all rows of the run");
    let (front_segments, back_segments) = segments.split_at(rows);
    let (front_branches, back_branches) = branches.split_at(rows);
    let (front_leaves, back_leaves) = leaves.split_at(slots);
    let front = BatchRun {
        batches: front,
        blocks: front_blocks,
        segments: front_segments,
        branches: front_branches,
        leaves: front_leaves,
        quiet,
    };
    let back = BatchRun {
        batches: back,
        blocks: back_blocks,
        segments: back_segments,
        branches: back_branches,
        leaves: back_leaves,
        quiet,
    };
    join(|| step_trees(cx, front, scratches, simd), || step_trees(cx, back, scratches, simd));
}

/// Steps one batch: inward and outward pass, or none between two solutions of the joints, and the leaves on its twigs.
fn step_batch(
    cx: &Context<'_>,
    blocks: &BatchBlocks,
    mut rows: Rows<'_>,
    scratch: &mut BlockScratch,
    leaves: BatchLeaves<'_>,
    simd: Simd,
) {
    if !cx.scene.sway.solves_joints(cx.step.index) {
        sway_coast(cx, &mut rows, simd);
    } else if cx.scene.sway_scheme == SCHEME_ARTICULATED {
        sway_inward(cx, &mut rows, blocks, scratch, simd);
        sway_outward(cx, &mut rows, blocks, scratch, simd);
    } else {
        sway_gather(cx, &mut rows);
        sway_follow(cx, &mut rows);
    }
    carry(cx, &mut rows, leaves, simd);
}
