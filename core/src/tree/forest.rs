// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! All trees of a world, laid out for stepping.
//!
//! Trees that follow one another form a stand, of a thousand segments and more. The rows of a stand are contiguous, and
//! within it lie level by level: first every trunk, then everything that grows from a trunk, and so on; siblings follow
//! one another. A CPU takes a stand from level to level while it stays in the cache; a GPU takes the same level of all
//! stands at once, by the list of rows in [`Forest::order`].

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::record::{NO_SEGMENT, Timber};
use super::skeleton::Skeleton;
use super::store::Branches;
use super::sway::unfold::segment_place;
use super::sway::{Body, Joint};
use super::timber::{LeafFacts, TreeFacts, timber_of};
use crate::kernel::{Quat, Vec3 as KernelVec3};
use crate::scene::TreeKind;

/// Segments from which on a stand takes no more trees.
const STAND_SEGMENTS: usize = 1024;

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
    /// Behind the last row of each level.
    pub ends: Vec<u32>,
    /// Leaf slots of its trees.
    pub slots: Range<u32>,
}

impl Stand {
    /// Number of rows.
    pub fn len(&self) -> usize {
        (self.ends.last().copied().unwrap_or(self.first) - self.first) as usize
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows of each level, from the trunks up, counted from the stand's first.
    pub fn levels(&self) -> impl DoubleEndedIterator<Item = Range<usize>> {
        let within = |row: u32| (row - self.first) as usize;
        let start = move |level: usize| if level == 0 { 0 } else { within(self.ends[level - 1]) };
        (0..self.ends.len()).map(move |level| start(level)..within(self.ends[level]))
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
        let depth = stands.iter().map(|stand: &Stand| stand.ends.len()).max().unwrap_or(0);
        let mut order = Vec::with_capacity(timber.len());
        let mut level_ends = Vec::with_capacity(depth);
        for level in 0..depth {
            for stand in &stands {
                if let Some(rows) = stand.levels().nth(level) {
                    order.extend((rows.start..rows.end).map(|row| stand.first + word(row)));
                }
            }
            level_ends.push(word(order.len()));
        }
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

/// Appends the trees from `first` on as a stand: rows level by level, links filled in.
fn lay_out(timber: &mut Vec<Timber>, trees: &mut [Planted], first: usize, drafts: Vec<Vec<Timber>>) -> Stand {
    let start = word(timber.len());
    let mut children: Vec<Vec<Vec<u32>>> = Vec::with_capacity(drafts.len());
    for tree in &mut trees[first..] {
        let mut of_tree = vec![Vec::new(); tree.skeleton.segments.len()];
        for (index, segment) in tree.skeleton.segments.iter().enumerate() {
            if let Some(parent) = segment.parent {
                of_tree[parent as usize].push(word(index));
            }
        }
        tree.rows = vec![NO_SEGMENT; of_tree.len()];
        children.push(of_tree);
    }
    let mut ends = Vec::new();
    let mut level: Vec<(usize, u32)> = (0..drafts.len()).map(|tree| (tree, 0)).collect();
    while !level.is_empty() {
        let mut next = Vec::new();
        let behind = word(timber.len() + level.len());
        for &(tree, segment) in &level {
            let row = word(timber.len());
            let mut constants = drafts[tree][segment as usize];
            let own = &children[tree][segment as usize];
            constants.tree = word(first + tree);
            constants.first_child = behind + word(next.len());
            constants.child_count = word(own.len());
            constants.parent = trees[first + tree].skeleton.segments[segment as usize]
                .parent
                .map_or(NO_SEGMENT, |parent| trees[first + tree].rows[parent as usize]);
            trees[first + tree].rows[segment as usize] = row;
            timber.push(constants);
            next.extend(own.iter().map(|&child| (tree, child)));
        }
        ends.push(word(timber.len()));
        level = next;
    }
    let slots = trees[first].slots.start..trees[trees.len() - 1].slots.end;
    Stand { first: start, ends, slots }
}
