// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Batches of trees that are stepped together, and the order of their segments.
//!
//! The rows of a batch are contiguous and lie in blocks: up to sixteen limbs of one level, those with the most twigs first,
//! and behind them their twigs, the first ones of all limbs, then the second ones, and so on. So what grows from a row has
//! a later one, and the twigs of a block lie as its limbs do.

use std::cmp::Reverse;
use std::ops::Range;

use glam::Vec3;

use super::forest::Planted;
use super::record::{NO_SEGMENT, SegmentConstants, TWIG};
use super::skeleton::Skeleton;
use crate::arith::pack::BLOCK;
use crate::convert::len32;

/// Largest distance in m at rest between the middle of a twig and the end of its parent, whose air it feels.
const TWIG_REACH_M: f32 = 0.5;

/// A few trees that are stepped together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeBatch {
    /// First row.
    pub first: u32,
    /// The blocks, from the trunks up.
    pub blocks: Vec<Block>,
    /// Its trees, by their number in the forest.
    pub trees: Range<usize>,
    /// Leaf slots of its trees.
    pub slots: Range<u32>,
}

impl TreeBatch {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.twigs().last().unwrap_or(block.limbs()).end)
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Limbs of one level and their twigs. Rows are counted from the batch's first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Limbs between the block and the ground.
    pub level: usize,
    /// The first row.
    pub row: usize,
    /// Number of limbs, up to [`BLOCK`].
    pub limbs: usize,
    /// Numbers of limbs, from the first, that have a first twig, a second one, and so on.
    pub twigs: Vec<usize>,
}

impl Block {
    /// Rows of the limbs.
    pub fn limbs(&self) -> Range<usize> {
        self.row..self.row + self.limbs
    }

    /// Rows of the first twigs, of the second ones, and so on.
    pub fn twigs(&self) -> impl Iterator<Item = Range<usize>> {
        self.twigs.iter().scan(self.row + self.limbs, |next, count| {
            let start = *next;
            *next += count;
            Some(start..*next)
        })
    }
}

/// All rows level by level, in each the limbs before the twigs, and behind the last one of each level.
pub(super) fn order_of(batches: &[TreeBatch]) -> (Vec<u32>, Vec<u32>) {
    let blocks =
        || batches.iter().flat_map(|batch| batch.blocks.iter().map(move |block| (batch.first, block)));
    let depth =
        blocks().map(|(_, block)| block.level + 1 + usize::from(!block.twigs.is_empty())).max().unwrap_or(0);
    let mut limbs = vec![Vec::new(); depth];
    let mut twigs = vec![Vec::new(); depth + 1];
    for (first, block) in blocks() {
        limbs[block.level].extend(block.limbs().map(|row| first + len32(row)));
        twigs[block.level + 1].extend(block.twigs().flatten().map(|row| first + len32(row)));
    }
    let mut order = Vec::new();
    let level_ends = limbs.iter().zip(&twigs).map(|(limbs, twigs)| {
        order.extend(limbs.iter().chain(twigs));
        len32(order.len())
    });
    let level_ends = level_ends.collect();
    (order, level_ends)
}

/// A segment of one of the trees that become a batch.
type Grown = (usize, u32);

/// Children of every segment of a tree: twigs, then limbs.
struct Children {
    twigs: Vec<Vec<u32>>,
    limbs: Vec<Vec<u32>>,
}

impl Children {
    fn of(skeleton: &Skeleton, segments: &[SegmentConstants]) -> Self {
        let count = skeleton.segments.len();
        let mut has_children = vec![false; count];
        for parent in skeleton.segments.iter().filter_map(|segment| segment.parent) {
            has_children[parent as usize] = true;
        }
        let mut children = Self { twigs: vec![Vec::new(); count], limbs: vec![Vec::new(); count] };
        for (index, segment) in skeleton.segments.iter().enumerate() {
            if let Some(parent) = segment.parent {
                let is_twig = !has_children[index] && is_near(&segments[index], &segments[parent as usize]);
                let kind = if is_twig { &mut children.twigs } else { &mut children.limbs };
                kind[parent as usize].push(len32(index));
            }
        }
        children
    }
}

/// Returns true if the centre of a segment is near enough to the end of its parent to take the wind there.
fn is_near(segment: &SegmentConstants, parent: &SegmentConstants) -> bool {
    let axis = glam::Quat::from_array(segment.rest) * Vec3::Y;
    let middle = Vec3::from(segment.offset) + axis * (0.5 * segment.length);
    middle.distance(Vec3::Y * parent.length) <= TWIG_REACH_M
}

/// A batch that is being laid out.
struct Layout<'a> {
    segments: &'a mut Vec<SegmentConstants>,
    trees: &'a mut [Planted],
    first_tree: usize,
    drafts: Vec<Vec<SegmentConstants>>,
}

impl Layout<'_> {
    /// The next row, for this segment, as the last child of its parent.
    fn push(&mut self, (tree, segment): Grown, first_child: u32) {
        let row = len32(self.segments.len());
        let planted = &mut self.trees[tree];
        planted.rows[segment as usize] = row;
        let mut constants = self.drafts[tree][segment as usize];
        let parent = planted.skeleton.segments[segment as usize].parent;
        constants.parent = parent.map_or(NO_SEGMENT, |parent| planted.rows[parent as usize]);
        constants.first_child = first_child;
        constants.tree = len32(self.first_tree + tree);
        self.segments.push(constants);
        self.link(row, constants.parent);
    }

    /// Makes a row the last child of its parent.
    fn link(&mut self, row: u32, parent: u32) {
        if parent == NO_SEGMENT {
            return;
        }
        let parent = &mut self.segments[parent as usize];
        if parent.first_child == NO_SEGMENT {
            parent.first_child = row;
            return;
        }
        let mut last = parent.first_child as usize;
        while self.segments[last].next_sibling != NO_SEGMENT {
            last = self.segments[last].next_sibling as usize;
        }
        self.segments[last].next_sibling = row;
    }
}

/// Appends the trees from `first` on as a batch: rows block by block, links filled in.
pub(super) fn lay_out(
    segments: &mut Vec<SegmentConstants>,
    trees: &mut [Planted],
    first: usize,
    drafts: Vec<Vec<SegmentConstants>>,
) -> TreeBatch {
    let start = len32(segments.len());
    let trees = &mut trees[first..];
    let slots = trees[0].slots.start..trees[trees.len() - 1].slots.end;
    let mut children = Vec::with_capacity(drafts.len());
    for (tree, draft) in trees.iter_mut().zip(&drafts) {
        children.push(Children::of(&tree.skeleton, draft));
        tree.rows = vec![NO_SEGMENT; draft.len()];
    }
    let mut layout = Layout { segments, trees, first_tree: first, drafts };
    let twigs_of = |&(tree, limb): &Grown| &children[tree].twigs[limb as usize];
    let mut blocks = Vec::new();
    let mut limbs: Vec<Grown> = (0..children.len()).map(|tree| (tree, 0)).collect();
    for level in 0.. {
        if limbs.is_empty() {
            break;
        }
        limbs.sort_by_key(|limb| Reverse(twigs_of(limb).len()));
        for limbs in limbs.chunks(BLOCK) {
            let row = layout.segments.len() - start as usize;
            for limb in limbs {
                layout.push(*limb, NO_SEGMENT);
            }
            let mut twigs = Vec::new();
            for number in 0..twigs_of(&limbs[0]).len() {
                let bearing = limbs.iter().take_while(|limb| number < twigs_of(limb).len());
                twigs.push(bearing.map(|limb| layout.push((limb.0, twigs_of(limb)[number]), TWIG)).count());
            }
            blocks.push(Block { level, row, limbs: limbs.len(), twigs });
        }
        let grow = |&(tree, limb): &Grown| {
            children[tree].limbs[limb as usize].iter().map(move |&child| (tree, child))
        };
        limbs = limbs.iter().flat_map(grow).collect();
    }
    TreeBatch { first: start, blocks, trees: first..first + children.len(), slots }
}
