// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps stands of trees with the leaves on them, several at a time.

use std::ops::Range;

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::LeavesMut;
use windfall_core::tree::forest::Stand;
use windfall_core::tree::record::Work;
use windfall_core::tree::sway::SCHEME_ARTICULATED;
use windfall_core::tree::sway::row::Rows;
use windfall_core::tree::{BranchesMut, Timber};

use super::carry::carry;
use super::sway_fold::sway_fold;
use super::sway_follow::sway_follow;
use super::sway_gather::sway_gather;
use super::sway_unfold::sway_unfold;
use crate::simd::Simd;

/// A run of stands with all that belongs to them.
pub(crate) struct Stands<'a> {
    pub(crate) stands: &'a [Stand],
    pub(crate) timber: &'a [Timber],
    pub(crate) branches: BranchesMut<'a>,
    pub(crate) work: &'a mut [Work],
    pub(crate) leaves: LeavesMut<'a>,
}

/// Steps all stands, halving the run until a piece is one.
pub(crate) fn sway(cx: &Context<'_>, run: Stands<'_>, simd: Simd) {
    let Stands { stands, timber, branches, work, leaves } = run;
    let [first, .., last] = stands else {
        if let [stand] = stands {
            sway_stand(cx, stand, Stands { stands, timber, branches, work, leaves }, simd);
        }
        return;
    };
    let (front, back) = stands.split_at(stands.len() / 2);
    let rows = (back[0].first - first.first) as usize;
    let slots = (back[0].slots.start - first.slots.start) as usize;
    debug_assert_eq!(timber.len(), (last.first - first.first) as usize + last.len(), "all rows of the run");
    let (front_timber, back_timber) = timber.split_at(rows);
    let (front_branches, back_branches) = branches.split_at(rows);
    let (front_work, back_work) = work.split_at_mut(rows);
    let (front_leaves, back_leaves) = leaves.split_at(slots);
    let front = Stands {
        stands: front,
        timber: front_timber,
        branches: front_branches,
        work: front_work,
        leaves: front_leaves,
    };
    let back = Stands {
        stands: back,
        timber: back_timber,
        branches: back_branches,
        work: back_work,
        leaves: back_leaves,
    };
    join(|| sway(cx, front, simd), || sway(cx, back, simd));
}

/// A pass over one level of a stand.
type Pass = fn(&Context<'_>, &mut Rows<'_>, Range<usize>, Simd);

/// One stand: towards the foot, towards the tips, and the leaves after it.
fn sway_stand(cx: &Context<'_>, stand: &Stand, run: Stands<'_>, simd: Simd) {
    let Stands { timber, branches, work, mut leaves, .. } = run;
    let mut rows = Rows { first: stand.first, timber, branches, work };
    let articulated = cx.environment.crowns.0[3] == SCHEME_ARTICULATED;
    let (inwards, outwards) = if articulated {
        (sway_fold as Pass, sway_unfold as Pass)
    } else {
        (sway_gather as Pass, sway_follow as Pass)
    };
    for level in stand.levels().rev() {
        inwards(cx, &mut rows, level, simd);
    }
    for level in stand.levels() {
        outwards(cx, &mut rows, level, simd);
    }
    carry(cx, &mut rows, &mut leaves, stand.slots.start);
}
