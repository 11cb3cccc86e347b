// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps stands of trees with the leaves on them, several at a time.

use std::sync::{Mutex, PoisonError};

use rayon::{current_thread_index, join};
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::tree::stand::Stand;
use windfall_core::tree::sway::SCHEME_ARTICULATED;
use windfall_core::tree::sway::row::Rows;
use windfall_core::tree::{BranchesMut, Timber};

use super::carry::carry;
use super::scratch::{BlockScratch, Scratch};
use super::sway_fold::sway_fold;
use super::sway_follow::sway_follow;
use super::sway_gather::sway_gather;
use super::sway_unfold::sway_unfold;
use super::timber_block::StandBlocks;
use crate::simd::Simd;

/// A run of stands with all that belongs to them.
pub(crate) struct Stands<'a> {
    pub(crate) stands: &'a [Stand],
    pub(crate) blocks: &'a [StandBlocks],
    pub(crate) timber: &'a [Timber],
    pub(crate) branches: BranchesMut<'a>,
    pub(crate) leaves: LeavesMut<'a>,
}

/// Steps all stands, halving the run until a piece is one. There is a scratch for each thread.
pub(crate) fn sway(cx: &Context<'_>, run: Stands<'_>, scratches: &[Mutex<Scratch>], simd: Simd) {
    let Stands { stands, blocks, timber, branches, leaves } = run;
    let [first, .., last] = stands else {
        if let ([stand], [blocks]) = (stands, blocks) {
            // A thread of another pool may have a larger number; then it waits for the scratch of another.
            let own = current_thread_index().unwrap_or(0) % scratches.len();
            let mut scratch = scratches[own].lock().unwrap_or_else(PoisonError::into_inner);
            let Scratch { work, blocks: kept } = &mut *scratch;
            let rows = Rows { first: stand.first, timber, branches, work };
            sway_stand(cx, blocks, rows, kept, leaves, stand.slots.start, simd);
        }
        return;
    };
    let half = stands.len() / 2;
    let (front, back) = stands.split_at(half);
    let (front_blocks, back_blocks) = blocks.split_at(half);
    let rows = (back[0].first - first.first) as usize;
    let slots = (back[0].slots.start - first.slots.start) as usize;
    debug_assert_eq!(timber.len(), (last.first - first.first) as usize + last.len(), "all rows of the run");
    let (front_timber, back_timber) = timber.split_at(rows);
    let (front_branches, back_branches) = branches.split_at(rows);
    let (front_leaves, back_leaves) = leaves.split_at(slots);
    let front = Stands {
        stands: front,
        blocks: front_blocks,
        timber: front_timber,
        branches: front_branches,
        leaves: front_leaves,
    };
    let back = Stands {
        stands: back,
        blocks: back_blocks,
        timber: back_timber,
        branches: back_branches,
        leaves: back_leaves,
    };
    join(|| sway(cx, front, scratches, simd), || sway(cx, back, scratches, simd));
}

/// One stand: towards the foot, towards the tips, and the leaves after it.
fn sway_stand(
    cx: &Context<'_>,
    blocks: &StandBlocks,
    mut rows: Rows<'_>,
    scratch: &mut BlockScratch,
    leaves: LeavesMut<'_>,
    first_slot: u32,
    simd: Simd,
) {
    if cx.environment.sway_scheme == SCHEME_ARTICULATED {
        sway_fold(cx, &mut rows, blocks, scratch, simd);
        sway_unfold(cx, &mut rows, blocks, scratch, simd);
    } else {
        sway_gather(cx, &mut rows);
        sway_follow(cx, &mut rows);
    }
    carry(cx, &mut rows, leaves, first_slot, simd);
}
