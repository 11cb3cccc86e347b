// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! All trees of a world, laid out for stepping.
//!
//! Trees that follow one another form a stand, of some thousand segments. Its rows are contiguous and lie in blocks: up to
//! sixteen limbs of one level, those with the most twigs first, and behind them their twigs, the first ones of all limbs,
//! then the second ones, and so on. So what grows from a row has a later one, and the twigs of a block lie as its limbs
//! do. A CPU takes a stand block by block while it stays in the cache; a GPU takes the same level of all stands at once, by
//! the list of rows in [`Forest::order`].

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::record::{NO_SEGMENT, TWIG, Timber};
use super::skeleton::Skeleton;
use super::store::Branches;
use super::sway::unfold::segment_place;
use super::sway::{Body, Joint};
use super::timber::{LeafFacts, TreeFacts, timber_of};
use crate::kernel::pack::BLOCK;
use crate::kernel::{Quat, Vec3 as KernelVec3};
use crate::scene::TreeKind;

/// Segments from which on a stand takes no more trees: more leave fewer blocks unfilled, fewer stay in a cache of 2 MB.
const STAND_SEGMENTS: usize = 4096;
/// Largest distance in m at rest between the middle of a twig and the end of its parent, whose air it feels.
const TWIG_REACH_M: f32 = 0.5;

/// A tree to be planted.
#[derive(Clone, Debug)]
pub struct Seedling {
    /// Its shape.
    pub skeleton: Arc<Skeleton>,
    /// What it is made of and bears.
    pub kind: TreeKind,
    /// One of its leaves.
    pub leaf: LeafFacts,
    /// Its foot in m.
    pub foot_m: Vec3,
    /// Leaf slots that it has.
    pub leaf_slots: u32,
}

/// A tree where it stands.
#[derive(Clone, Debug)]
pub struct Planted {
    /// Its shape, in its own frame.
    pub skeleton: Arc<Skeleton>,
    /// Its foot in m.
    pub foot_m: Vec3,
    /// Row of each segment of the skeleton.
    pub rows: Vec<u32>,
    /// Its leaf slots.
    pub slots: Range<u32>,
    /// What it comes to.
    pub facts: TreeFacts,
}

/// A few trees that are stepped together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stand {
    /// First row.
    pub first: u32,
    /// The blocks, from the trunks up.
    pub blocks: Vec<Block>,
    /// Leaf slots of its trees.
    pub slots: Range<u32>,
}

impl Stand {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.twigs().last().unwrap_or(block.limbs()).end)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Limbs of one level and their twigs. Rows are counted from the stand's first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Limbs between the block and the ground.
    pub level: usize,
    /// The first row.
    pub row: usize,
    /// Number of limbs, up to [`BLOCK`].
    pub limbs: usize,
    /// How many limbs, from the first, have a first twig, a second one, and so on.
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

/// All trees of a world.
#[derive(Clone, Debug, Default)]
pub struct Forest {
    timber: Arc<[Timber]>,
    order: Arc<[u32]>,
    level_ends: Vec<u32>,
    stands: Vec<Stand>,
    trees: Vec<Planted>,
}

impl Forest {
    /// Plants trees for steps of `dt_s` seconds; skeletons are valid.
    pub fn plant(seedlings: Vec<Seedling>, dt_s: f32) -> Self {
        let mut timber = Vec::new();
        let mut stands = Vec::new();
        let mut trees: Vec<Planted> = Vec::new();
        let mut drafts = Vec::new();
        let mut waiting = 0;
        let mut next_slot = 0;
        let count = seedlings.len();
        for (number, seedling) in seedlings.into_iter().enumerate() {
            let Seedling { skeleton, kind, leaf, foot_m, leaf_slots } = seedling;
            let slots = next_slot..next_slot + leaf_slots;
            next_slot = slots.end;
            let (mut constants, facts) = timber_of(&skeleton, &kind.wood, &kind.foliage, leaf, dt_s);
            let offset = (Vec3::from(constants[0].offset) + foot_m).to_array();
            constants[0].offset = offset;
            waiting += constants.len();
            drafts.push(constants);
            trees.push(Planted { skeleton, foot_m, rows: Vec::new(), slots, facts });
            if waiting >= STAND_SEGMENTS || number + 1 == count {
                let first = trees.len() - drafts.len();
                stands.push(lay_out(&mut timber, &mut trees, first, std::mem::take(&mut drafts)));
                waiting = 0;
            }
        }
        let (order, level_ends) = order_of(&stands);
        Self { timber: timber.into(), order: order.into(), level_ends, stands, trees }
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.timber.len()
    }

    /// Whether there are no trees.
    pub fn is_empty(&self) -> bool {
        self.timber.is_empty()
    }

    /// Constants of the segments, row by row.
    pub fn timber(&self) -> &Arc<[Timber]> {
        &self.timber
    }

    /// All rows, level by level over the whole forest.
    pub fn order(&self) -> &Arc<[u32]> {
        &self.order
    }

    /// Behind the last row of each level in [`Forest::order`].
    pub fn level_ends(&self) -> &[u32] {
        &self.level_ends
    }

    /// The stands, in the order of their rows.
    pub fn stands(&self) -> &[Stand] {
        &self.stands
    }

    /// The trees, in the order of the scene.
    pub fn trees(&self) -> &[Planted] {
        &self.trees
    }

    /// All segments in still air, with no leaves.
    pub fn at_rest(&self) -> Branches {
        let mut branches = Branches::zeroed(self.len());
        for &row in self.order.iter() {
            let row = row as usize;
            let timber = &self.timber[row];
            let parent = match timber.parent {
                NO_SEGMENT => Body::GROUND,
                parent => Body {
                    base: first_three(branches.base[parent as usize]),
                    pose: branches.pose[parent as usize].into(),
                    ..Body::GROUND
                },
            };
            let joint = Joint { turn: Quat::IDENTITY, rate: KernelVec3::ZERO };
            let body = segment_place(&timber.into(), &joint, &parent);
            branches.turn[row] = Quat::IDENTITY.to_array();
            branches.base[row] = [body.base.x, body.base.y, body.base.z, 0.0];
            branches.pose[row] = body.pose.to_array();
        }
        branches
    }
}

/// The first three of four.
pub(crate) fn first_three([x, y, z, _]: [f32; 4]) -> KernelVec3 {
    KernelVec3::new(x, y, z)
}

#[expect(clippy::cast_possible_truncation, reason = "segments are counted in words")]
fn word(number: usize) -> u32 {
    number as u32
}

/// All rows level by level, in each the limbs before the twigs, and behind the last one of each level.
fn order_of(stands: &[Stand]) -> (Vec<u32>, Vec<u32>) {
    let blocks =
        || stands.iter().flat_map(|stand| stand.blocks.iter().map(move |block| (stand.first, block)));
    let depth =
        blocks().map(|(_, block)| block.level + 1 + usize::from(!block.twigs.is_empty())).max().unwrap_or(0);
    let mut limbs = vec![Vec::new(); depth];
    let mut twigs = vec![Vec::new(); depth + 1];
    for (first, block) in blocks() {
        limbs[block.level].extend(block.limbs().map(|row| first + word(row)));
        twigs[block.level + 1].extend(block.twigs().flatten().map(|row| first + word(row)));
    }
    let mut order = Vec::new();
    let level_ends = limbs.iter().zip(&twigs).map(|(limbs, twigs)| {
        order.extend(limbs.iter().chain(twigs));
        word(order.len())
    });
    let level_ends = level_ends.collect();
    (order, level_ends)
}

/// A segment of one of the trees that become a stand.
type Grown = (usize, u32);

/// Children of every segment of a tree: twigs, then limbs.
struct Children {
    twigs: Vec<Vec<u32>>,
    limbs: Vec<Vec<u32>>,
}

impl Children {
    fn of(skeleton: &Skeleton, timber: &[Timber]) -> Self {
        let count = skeleton.segments.len();
        let mut bears = vec![false; count];
        for parent in skeleton.segments.iter().filter_map(|segment| segment.parent) {
            bears[parent as usize] = true;
        }
        let mut children = Self { twigs: vec![Vec::new(); count], limbs: vec![Vec::new(); count] };
        for (index, segment) in skeleton.segments.iter().enumerate() {
            if let Some(parent) = segment.parent {
                let is_twig = !bears[index] && is_near(&timber[index], &timber[parent as usize]);
                let kind = if is_twig { &mut children.twigs } else { &mut children.limbs };
                kind[parent as usize].push(word(index));
            }
        }
        children
    }
}

/// Whether the middle of a segment is near enough to the end of its parent to feel the same air.
fn is_near(timber: &Timber, parent: &Timber) -> bool {
    let axis = glam::Quat::from_array(timber.rest) * Vec3::Y;
    let middle = Vec3::from(timber.offset) + axis * (0.5 * timber.length);
    middle.distance(Vec3::Y * parent.length) <= TWIG_REACH_M
}

/// A stand that is being laid out.
struct Layout<'a> {
    timber: &'a mut Vec<Timber>,
    trees: &'a mut [Planted],
    first_tree: usize,
    drafts: Vec<Vec<Timber>>,
}

impl Layout<'_> {
    /// The next row, for this segment, as the last child of its parent.
    fn push(&mut self, (tree, segment): Grown, first_child: u32) {
        let row = word(self.timber.len());
        let planted = &mut self.trees[tree];
        planted.rows[segment as usize] = row;
        let mut constants = self.drafts[tree][segment as usize];
        let parent = planted.skeleton.segments[segment as usize].parent;
        constants.parent = parent.map_or(NO_SEGMENT, |parent| planted.rows[parent as usize]);
        constants.first_child = first_child;
        constants.tree = word(self.first_tree + tree);
        self.timber.push(constants);
        self.link(row, constants.parent);
    }

    /// Makes a row the last child of its parent.
    fn link(&mut self, row: u32, parent: u32) {
        if parent == NO_SEGMENT {
            return;
        }
        let parent = &mut self.timber[parent as usize];
        if parent.first_child == NO_SEGMENT {
            parent.first_child = row;
            return;
        }
        let mut last = parent.first_child as usize;
        while self.timber[last].next_sibling != NO_SEGMENT {
            last = self.timber[last].next_sibling as usize;
        }
        self.timber[last].next_sibling = row;
    }
}

/// Appends the trees from `first` on as a stand: rows block by block, links filled in.
fn lay_out(timber: &mut Vec<Timber>, trees: &mut [Planted], first: usize, drafts: Vec<Vec<Timber>>) -> Stand {
    let start = word(timber.len());
    let trees = &mut trees[first..];
    let slots = trees[0].slots.start..trees[trees.len() - 1].slots.end;
    let mut children = Vec::with_capacity(drafts.len());
    for (tree, draft) in trees.iter_mut().zip(&drafts) {
        children.push(Children::of(&tree.skeleton, draft));
        tree.rows = vec![NO_SEGMENT; draft.len()];
    }
    let mut layout = Layout { timber, trees, first_tree: first, drafts };
    let twigs_of = |&(tree, limb): &Grown| &children[tree].twigs[limb as usize];
    let mut blocks = Vec::new();
    let mut limbs: Vec<Grown> = (0..children.len()).map(|tree| (tree, 0)).collect();
    for level in 0.. {
        if limbs.is_empty() {
            break;
        }
        limbs.sort_by_key(|limb| std::cmp::Reverse(twigs_of(limb).len()));
        for limbs in limbs.chunks(BLOCK) {
            let row = layout.timber.len() - start as usize;
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
    Stand { first: start, blocks, slots }
}
