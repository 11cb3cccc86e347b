// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the passes over a block of segments find side by side: constants and links.
//!
//! Constants never change, so they need not be turned from rows into lanes. Lane and row of a block go together as
//! [`row_of_lane`] says; lanes without a row hold the block's last one once more.

use std::ops::Range;

use windfall_core::arith::pack::{BLOCK, Pack, row_of_lane};
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::tree::sway::Constants;
use windfall_core::tree::batch::TreeBatch;
use windfall_core::tree::record::{SegmentConstants, children_of};

/// Numbers of a [`SegmentConstants`] that are floats: all but its last row of links.
const FLOATS: usize = size_of::<SegmentConstants>() / 4 - 4;
/// Those that the pass towards the tips reads: rest and offset.
pub(super) const OUTWARD: Range<usize> = 0..7;
/// Those that the pass towards the foot reads: all others.
pub(super) const INWARD: Range<usize> = OUTWARD.end..FLOATS;
/// Records of four that a limb hands to its parent.
pub(super) const HANDED: usize = 7;
/// Records of four of a limb's motion.
pub(super) const MOTIONS: usize = 2;

/// One number of all segments of a block, in a cache line of its own: a register of 64 bytes that straddles two lines takes
/// two accesses.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Lanes([f32; BLOCK]);

impl Lanes {
    pub(super) const ZERO: Self = Self([0.0; BLOCK]);

    /// One part of them.
    #[inline(always)]
    pub(super) fn load<P: Pack>(&self, simd: P::Simd, part: usize) -> P {
        P::load(simd, &self.0[part * P::LANES..])
    }

    /// Changes one part of them.
    #[inline(always)]
    pub(super) fn store<P: Pack>(&mut self, part: usize, numbers: P) {
        numbers.store(&mut self.0[part * P::LANES..]);
    }
}

/// One index for each segment of a block.
type Indices = [u32; BLOCK];

/// Constants of rows that follow one another.
#[derive(Clone, Debug)]
pub(crate) struct SegmentBlock {
    /// The rows, counted from the batch's first.
    pub(crate) rows: Range<usize>,
    floats: [Lanes; FLOATS],
}

/// Parents of a block's limbs.
#[derive(Clone, Debug)]
pub(crate) struct Parents {
    /// Their rows.
    pub(crate) rows: Indices,
    /// Their places in [`super::scratch::BlockScratch::motions`].
    pub(crate) motions: Indices,
}

/// Limbs of a block.
#[derive(Clone, Debug)]
pub(crate) struct LimbBlock {
    pub(crate) segments: SegmentBlock,
    /// None for trunks, which grow from the ground.
    pub(crate) parents: Option<Parents>,
    /// Part of the batch's children: the first child limbs of all lanes, then the second, and so on.
    children: Range<usize>,
    /// Part of the batch's twigs: the first twigs of all lanes, then the second, and so on.
    pub(crate) twigs: Range<usize>,
}

/// The blocks of a batch in the order of the pass towards the foot, which reads the most of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct BatchBlocks {
    pub(crate) limbs: Vec<LimbBlock>,
    pub(crate) twigs: Vec<SegmentBlock>,
    /// Places in [`super::scratch::BlockScratch::handed`].
    children: Vec<Indices>,
}

impl BatchBlocks {
    /// The blocks of a batch with these constants. What has no child hears of the place behind the last of `most` blocks.
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
                let nothing = places.place(most * BLOCK, HANDED);
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

    /// The child limbs of a block, one row for each number of a child.
    #[inline(always)]
    pub(crate) fn children(&self, block: &LimbBlock) -> &[Indices] {
        &self.children[block.children.clone()]
    }
}

/// Where the limbs of a batch are: sixteen to a block, whether it is full or not.
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

    /// The first of a limb's `columns` records, where those of a block lie column by column.
    fn place(&self, limb: usize, columns: usize) -> u32 {
        word(limb / BLOCK * columns * BLOCK + limb % BLOCK)
    }

    /// What the child limbs of a row hand down.
    fn children(&self, batch: &TreeBatch, segments: &[SegmentConstants], row: usize) -> Vec<u32> {
        children_of(segments, batch.first, row)
            .filter(|child| !segments[*child].is_twig())
            .map(|child| self.place(self.of_row[child], HANDED))
            .collect()
    }

    fn parents(&self, batch: &TreeBatch, segments: &[SegmentConstants], limbs: &SegmentBlock) -> Parents {
        let rows = limbs.rows_of_lanes().map(|row| segments[row].parent - batch.first);
        Parents { rows, motions: rows.map(|row| self.place(self.of_row[row as usize], MOTIONS)) }
    }
}

/// A number of segments, slots or lanes.
#[expect(clippy::cast_possible_truncation, reason = "they are counted in words")]
pub(super) const fn word(number: usize) -> u32 {
    number as u32
}

impl SegmentBlock {
    fn new(rows: Range<usize>, segments: &[SegmentConstants]) -> Self {
        let mut block = Self { rows, floats: [Lanes::ZERO; FLOATS] };
        for (lane, row) in block.rows_of_lanes().into_iter().enumerate() {
            let floats: &[f32; FLOATS + 4] = bytemuck::must_cast_ref(&segments[row]);
            for (lanes, float) in block.floats.iter_mut().zip(floats) {
                lanes.0[lane] = *float;
            }
        }
        block
    }

    /// The row of every lane.
    fn rows_of_lanes(&self) -> [usize; BLOCK] {
        std::array::from_fn(|lane| self.rows.start + row_of_lane(lane).min(self.rows.len() - 1))
    }

    /// Some of the numbers.
    #[inline(always)]
    pub(super) fn lanes(&self, numbers: Range<usize>) -> &[Lanes] {
        &self.floats[numbers]
    }

    /// One number.
    #[inline(always)]
    fn float<P: Pack>(&self, simd: P::Simd, of: usize, part: usize) -> P {
        self.floats[of].load(simd, part)
    }

    /// Three numbers.
    #[inline(always)]
    fn vector<P: Pack>(&self, simd: P::Simd, of: usize, part: usize) -> Vec3<P> {
        Vec3::new(self.float(simd, of, part), self.float(simd, of + 1, part), self.float(simd, of + 2, part))
    }

    /// All constants, in the order of [`SegmentConstants`].
    #[inline(always)]
    pub(crate) fn constants<P: Pack>(&self, simd: P::Simd, part: usize) -> Constants<P> {
        Constants {
            rest: Quat::new(
                self.float(simd, 0, part),
                self.float(simd, 1, part),
                self.float(simd, 2, part),
                self.float(simd, 3, part),
            ),
            offset: self.vector(simd, 4, part),
            length: self.float(simd, 7, part),
            mass: self.float(simd, 8, part),
            first_moment: self.float(simd, 9, part),
            inertia_across: self.float(simd, 10, part),
            inertia_along: self.float(simd, 11, part),
            leaf_mass: self.float(simd, 12, part),
            wood_drag: self.float(simd, 13, part),
            leaf_drag: self.float(simd, 14, part),
            leaf_yield: self.float(simd, 15, part),
            preload: self.vector(simd, 16, part),
            damping: self.float(simd, 19, part),
            bending: self.float(simd, 20, part),
            twisting: self.float(simd, 21, part),
            bending_inertia: self.float(simd, 22, part),
            twisting_inertia: self.float(simd, 23, part),
        }
    }
}
