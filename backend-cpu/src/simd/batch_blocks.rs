// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constants and links of the blocks of a batch of trees, lane by lane, and their prefetching.
//!
//! A block has sixteen lanes: one pack of sixteen, or two of eight, parts 0 and 1. Lane and row of a block go together as
//! [`row_of_lane`] says; lanes without a row hold the block's last one once more, and nothing reads what they compute.
//! Constants never change, so they need not be transposed from rows into lanes in every step.

use std::mem::offset_of;
use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack, row_of_lane};
use windfall_core::device::tree::sway::Constants;
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::tree::batch::TreeBatch;
use windfall_core::tree::record::{SegmentConstants, children_of};

use super::branch_block::word;
use super::lanes::Lanes;
use super::prefetch::{SECOND_LEVEL, prefetch};
use super::sway_scratch::{ACCELERATION_RECORDS, INERTIA_RECORDS};

/// One index for each segment of a block.
type Indices = [u32; BLOCK];

/// Constants of segments in rows that follow one another.
#[derive(Clone, Debug)]
pub(crate) struct SegmentBlock {
    /// Rows of the segments, counted from the batch's first.
    pub(crate) rows: Range<usize>,
    constants: Constants<Lanes>,
}

/// Parents of a block's limbs.
#[derive(Clone, Debug)]
pub(crate) struct Parents {
    /// Rows of the parents.
    pub(crate) rows: Indices,
    /// Indices of their records in [`super::sway_scratch::BlockScratch::accelerations`].
    pub(crate) accelerations: Indices,
}

/// Limbs of a block.
#[derive(Clone, Debug)]
pub(crate) struct LimbBlock {
    pub(crate) segments: SegmentBlock,
    /// None for trunks, which grow from the ground.
    pub(crate) parents: Option<Parents>,
    /// Range of the batch's children: the first child limbs of all lanes, then the second, and so on.
    children: Range<usize>,
    /// Range of the batch's twigs: the first twigs of all lanes, then the second, and so on.
    pub(crate) twigs: Range<usize>,
}

/// Blocks of a batch in the order of the inward pass, which reads the most of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct BatchBlocks {
    pub(crate) limbs: Vec<LimbBlock>,
    pub(crate) twigs: Vec<SegmentBlock>,
    /// Indices of records in [`super::sway_scratch::BlockScratch::inertias`].
    children: Vec<Indices>,
}

impl BatchBlocks {
    /// Blocks of a batch with these constants. A missing child has the index behind the last of `most` blocks.
    pub(crate) fn new(batch: &TreeBatch, segments: &[SegmentConstants], most: usize) -> Self {
        let mut blocks = Self::default();
        let places = Places::of(batch);
        for block in batch.blocks.iter().rev() {
            let limbs = SegmentBlock::new(block.limbs(), segments);
            let first_twigs = blocks.twigs.len();
            blocks.twigs.extend(block.twigs().map(|rows| SegmentBlock::new(rows, segments)));
            let first_child = blocks.children.len();
            let children = limbs.rows_of_lanes().map(|row| places.children(batch, segments, row));
            let longest = children.iter().map(Vec::len).max().unwrap_or(0);
            blocks.children.extend((0..longest).map(|number| {
                let nothing = record_index(most * BLOCK, INERTIA_RECORDS);
                std::array::from_fn(|lane| children[lane].get(number).copied().unwrap_or(nothing))
            }));
            blocks.limbs.push(LimbBlock {
                parents: (block.level > 0).then(|| places.parents(batch, segments, &limbs)),
                segments: limbs,
                children: first_child..blocks.children.len(),
                twigs: first_twigs..blocks.twigs.len(),
            });
        }
        blocks
    }

    /// Child limbs of a block, one row for each number of a child.
    #[inline(always)]
    pub(crate) fn children(&self, block: &LimbBlock) -> &[Indices] {
        &self.children[block.children.clone()]
    }
}

/// Places of the limbs of a batch: sixteen to a block, whether it is full or not.
struct Places {
    of_row: Vec<usize>,
}

impl Places {
    fn of(batch: &TreeBatch) -> Self {
        let mut of_row = vec![usize::MAX; batch.len()];
        for (number, block) in batch.blocks.iter().rev().enumerate() {
            for (lane, row) in block.limbs().enumerate() {
                of_row[row] = number * BLOCK + lane;
            }
        }
        Self { of_row }
    }

    /// Indices of the inertias that the child limbs of a row pass on.
    fn children(&self, batch: &TreeBatch, segments: &[SegmentConstants], row: usize) -> Vec<u32> {
        children_of(segments, batch.first, row)
            .filter(|child| !segments[*child].is_twig())
            .map(|child| record_index(self.of_row[child], INERTIA_RECORDS))
            .collect()
    }

    fn parents(&self, batch: &TreeBatch, segments: &[SegmentConstants], limbs: &SegmentBlock) -> Parents {
        let rows = limbs.rows_of_lanes().map(|row| segments[row].parent - batch.first);
        let accelerations = rows.map(|row| record_index(self.of_row[row as usize], ACCELERATION_RECORDS));
        Parents { rows, accelerations }
    }
}

/// Index of the first of a limb's `columns` records, where those of a block lie column by column.
fn record_index(limb: usize, columns: usize) -> u32 {
    word(limb / BLOCK * columns * BLOCK + limb % BLOCK)
}

impl SegmentBlock {
    fn new(rows: Range<usize>, segments: &[SegmentConstants]) -> Self {
        let constants_of = |row: usize| Constants::from(&segments[row]);
        let mut block = Self { constants: constants_of(rows.start).map(|_| Lanes::default()), rows };
        for (lane, row) in block.rows_of_lanes().into_iter().enumerate() {
            block.constants.zip_mut(&constants_of(row), |lanes, number| lanes.0[lane] = *number);
        }
        block
    }

    /// Row of every lane.
    fn rows_of_lanes(&self) -> [usize; BLOCK] {
        std::array::from_fn(|lane| self.rows.start + row_of_lane(lane).min(self.rows.len() - 1))
    }

    /// Constants of part of the block.
    #[inline(always)]
    pub(crate) fn constants<P: Pack>(&self, simd: P::Simd, part: usize) -> Constants<P> {
        self.constants.map(
            #[inline(always)]
            |lanes| lanes.load(simd, part),
        )
    }
}

/// A batch of trees in a step.
pub(crate) struct BatchStep<'a, 'b> {
    pub(crate) cx: &'a Context<'a>,
    pub(crate) rows: &'a mut Rows<'b>,
    pub(crate) blocks: &'a BatchBlocks,
}

/// Constants that a pass reads, as bytes of [`Constants`].
pub(crate) struct ConstantsOf(Range<usize>);

/// First of the constants that the inward pass reads: behind rest and offset, the only ones of the outward pass.
const INWARD_OFFSET: usize = offset_of!(Constants<Lanes>, length);

impl ConstantsOf {
    pub(crate) const INWARD: Self = Self(INWARD_OFFSET..size_of::<Constants<Lanes>>());
    pub(crate) const OUTWARD: Self = Self(0..INWARD_OFFSET);
}

/// Number of blocks of limbs, or of twigs, to prefetch ahead, into the second level of cache, which gained more than the first: one is too late where
/// memory is slow, four and more gain nothing.
pub(crate) const AHEAD: usize = 2;

/// Prefetching of state, leaf counts and the constants of a pass.
///
/// A block with its twigs is some ninety cache lines in eight columns and two tables, a few lines from each page: processors do not all foresee them.
/// Many at once hold a core up, so limbs and each block of twigs are prefetched apart, with work in between.
impl BatchStep<'_, '_> {
    /// Prefetches a block of limbs, if there is such a block.
    #[inline(always)]
    pub(crate) fn prefetch_limbs(&self, number: usize, constants: &ConstantsOf) {
        if let Some(block) = self.blocks.limbs.get(number) {
            self.prefetch_rows(&block.segments, constants);
        }
    }

    /// Prefetches the air at a block of limbs, if there is such a block.
    #[inline(always)]
    pub(crate) fn prefetch_airs(&self, number: usize) {
        if let Some(block) = self.blocks.limbs.get(number) {
            let airs = self.rows.branches.air.as_ptr().wrapping_add(block.segments.rows.start);
            prefetch::<SECOND_LEVEL, _>(airs, BLOCK);
        }
    }

    /// Prefetches a block of twigs, if there is such a block.
    #[inline(always)]
    pub(crate) fn prefetch_twigs(&self, number: usize, constants: &ConstantsOf) {
        if let Some(twigs) = self.blocks.twigs.get(number) {
            self.prefetch_rows(twigs, constants);
        }
    }

    #[inline(always)]
    fn prefetch_rows(&self, segments: &SegmentBlock, ConstantsOf(bytes): &ConstantsOf) {
        let constants = std::ptr::from_ref(&segments.constants).cast::<u8>();
        prefetch::<SECOND_LEVEL, _>(constants.wrapping_add(bytes.start), bytes.len());
        let branches = &self.rows.branches;
        let first = segments.rows.start;
        prefetch::<SECOND_LEVEL, _>(branches.turn.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.rate.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.base.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.pose.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.velocity.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.spin.as_ptr().wrapping_add(first), BLOCK);
        prefetch::<SECOND_LEVEL, _>(branches.leaf_count.as_ptr().wrapping_add(first), BLOCK);
    }
}
