// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/carry.wgsl
//!
//! Moves the leaves on the twigs of a batch, and breaks petioles.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::blocks::SOURCE_TREES;
use windfall_core::device::leaf::carry::{
    CarriedLeaf, PetioleLanes, leaf_carry, leaf_follow, leaf_hangs, leaf_return,
};
use windfall_core::device::leaf::petiole::{SHED_INTERVAL, petiole_of};
use windfall_core::device::tree::sway::Body;
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::leaf::LeavesMut;
use windfall_core::tree::record::NO_SEGMENT;

use crate::quiet::QuietUnits;
use crate::simd::branch_block::word;
use crate::simd::leaf_block::{LeafBlock, sample_air};
use crate::simd::{Simd, in_packs};

/// Slots of which as many sample the wind in a step as a block has lanes.
const GROUP: usize = BLOCK * SHED_INTERVAL as usize;

/// Leaves of a batch.
pub(crate) struct BatchLeaves<'a> {
    pub(crate) leaves: LeavesMut<'a>,
    /// Slot of the first.
    pub(crate) first: u32,
    pub(crate) quiet: &'a QuietUnits,
}

/// Moves the leaves of a batch.
pub(crate) fn carry(cx: &Context<'_>, rows: &mut Rows<'_>, of_batch: BatchLeaves<'_>, simd: Simd) {
    let BatchLeaves { mut leaves, first, quiet } = of_batch;
    match simd {
        Simd::Scalar => carry_each(cx, rows, &mut leaves, quiet, first, leaf_carry),
        Simd::Lanes(level) => in_packs!(level, carry_lanes(cx, rows, leaves, quiet, first)),
    }
}

/// Does to one leaf after another what may change the number of leaves on its segment.
#[inline(always)]
fn carry_each(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &QuietUnits,
    first: u32,
    change: impl Fn(&Context<'_>, &mut CarriedLeaf<'_>, u32, &PetioleLanes, &Body) -> u32,
) {
    for (slot, leaf) in (first..).zip(leaves.iter_mut()) {
        let petiole = petiole_of(cx, slot);
        if petiole.segment != NO_SEGMENT {
            let row = (petiole.segment - rows.first) as usize;
            let change = change(cx, &mut leaf.into(), slot, &PetioleLanes::from(&petiole), &rows.body(row));
            let leaf_count = &mut rows.branches.leaf_count[row];
            *leaf_count = leaf_count.wrapping_add(change);
            if change != 0 {
                quiet.wake(slot);
            }
        }
    }
}

/// Group after group of slots: those that grow back one by one, those that sample the wind together, and all that hang
/// block by block.
#[inline(always)]
fn carry_lanes<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    leaves: LeavesMut<'_>,
    quiet: &QuietUnits,
    first: u32,
) {
    let grow_back = cx.scene.sources[SOURCE_TREES as usize].lifetime_steps != 0;
    let mut slot = first;
    let mut rest = leaves;
    while !rest.is_empty() {
        let (mut group, others) = {
            let count = rest.len().min(GROUP);
            rest.split_at(count)
        };
        let count = group.len();
        if grow_back {
            carry_each(cx, rows, &mut group, quiet, slot, |cx, leaf, _, petiole, _| {
                leaf_return(cx, leaf, petiole.bits)
            });
        }
        for part in 0..BLOCK / P::LANES {
            sample_air::<P>(simd, cx, rows, &mut group, quiet, slot, part);
        }
        let (blocks, mut few) = group.split_at(count - count % BLOCK);
        let few_first = slot + word(blocks.len());
        follow::<P>(simd, cx, rows, blocks, slot);
        carry_each(cx, rows, &mut few, quiet, few_first, |cx, leaf, slot, petiole, segment| {
            if leaf_hangs(cx, leaf.place.bits, leaf.schedule.event) {
                leaf_follow(cx, leaf, slot, petiole, segment);
            }
            0
        });
        slot += word(count);
        rest = others;
    }
}

/// Whole blocks of slots.
#[inline(always)]
fn follow<P: Pack>(simd: P::Simd, cx: &Context<'_>, rows: &Rows<'_>, leaves: LeavesMut<'_>, first: u32) {
    let (place, _) = leaves.place.as_chunks_mut::<BLOCK>();
    let (drift, _) = leaves.drift.as_chunks_mut::<BLOCK>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<BLOCK>();
    let (schedule, _) = leaves.schedule.as_chunks_mut::<BLOCK>();
    let records = place.iter_mut().zip(drift).zip(attitude).zip(schedule);
    for (first, (((place, drift), attitude), schedule)) in (first..).step_by(BLOCK).zip(records) {
        LeafBlock { first, place, drift, attitude, schedule }.follow::<P>(simd, cx, rows);
    }
}
