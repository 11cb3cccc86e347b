// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! All trees of a world, laid out for stepping.
//!
//! Trees that follow one another form a batch, of some thousand segments ([`TreeBatch`]). A CPU takes a batch block by block
//! while it stays in the cache; a GPU takes the same level of all batches at once, by the list of rows in
//! [`Forest::order`].

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::batch::{TreeBatch, lay_out, order_of};
use super::constants::{LeafFacts, TreeFacts, segment_constants};
use super::record::{NO_SEGMENT, SegmentConstants};
use super::skeleton::Skeleton;
use super::store::Branches;
use crate::arith::{Quat, Vec3 as KernelVec3};
use crate::device::tree::sway::outward::segment_place;
use crate::device::tree::sway::{Body, Joint};
use crate::scene::TreeKind;

/// Segments from which on a batch takes no more trees: more leave fewer blocks unfilled, fewer stay in a cache of 2 MB.
const BATCH_SEGMENTS: usize = 4096;

/// A tree to be planted.
#[derive(Clone, Debug)]
pub struct Seedling {
    /// Its shape.
    pub skeleton: Arc<Skeleton>,
    /// Its wood and foliage.
    pub kind: TreeKind,
    /// One of its leaves.
    pub leaf: LeafFacts,
    /// Its foot in m.
    pub foot_m: Vec3,
    /// Leaf slots that it has.
    pub leaf_slots: u32,
}

/// A tree at its place.
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
    /// Its totals.
    pub facts: TreeFacts,
}

/// All trees of a world.
#[derive(Clone, Debug, Default)]
pub struct Forest {
    segments: Arc<[SegmentConstants]>,
    order: Arc<[u32]>,
    level_ends: Vec<u32>,
    batches: Vec<TreeBatch>,
    trees: Vec<Planted>,
}

impl Forest {
    /// Plants trees; skeletons are valid.
    pub fn plant(seedlings: Vec<Seedling>, gravity_m_s2: f32) -> Self {
        let mut segments = Vec::new();
        let mut batches = Vec::new();
        let mut trees: Vec<Planted> = Vec::new();
        let mut drafts = Vec::new();
        let mut waiting = 0;
        let mut next_slot = 0;
        let count = seedlings.len();
        for (number, seedling) in seedlings.into_iter().enumerate() {
            let Seedling { skeleton, kind, leaf, foot_m, leaf_slots } = seedling;
            let slots = next_slot..next_slot + leaf_slots;
            next_slot = slots.end;
            let (mut constants, facts) =
                segment_constants(&skeleton, &kind.wood, &kind.foliage, leaf, gravity_m_s2);
            let offset = (Vec3::from(constants[0].offset) + foot_m).to_array();
            constants[0].offset = offset;
            waiting += constants.len();
            drafts.push(constants);
            trees.push(Planted { skeleton, foot_m, rows: Vec::new(), slots, facts });
            if waiting >= BATCH_SEGMENTS || number + 1 == count {
                let first = trees.len() - drafts.len();
                batches.push(lay_out(&mut segments, &mut trees, first, std::mem::take(&mut drafts)));
                waiting = 0;
            }
        }
        let (order, level_ends) = order_of(&batches);
        Self { segments: segments.into(), order: order.into(), level_ends, batches, trees }
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.segments.len()
    }

    /// Returns true if there are no trees that are stepped.
    pub fn is_empty(&self) -> bool {
        self.batches.is_empty()
    }

    /// Steps no trees but those of some batches from now on. Rows stay as they are.
    pub(crate) fn keep(&mut self, batches: Range<usize>) {
        self.batches = self.batches[batches].to_vec();
        let (order, level_ends) = order_of(&self.batches);
        (self.order, self.level_ends) = (order.into(), level_ends);
    }

    /// Constants of the segments, row by row.
    pub fn segments(&self) -> &Arc<[SegmentConstants]> {
        &self.segments
    }

    /// Rows of the trees that are stepped, level by level over all of them.
    pub fn order(&self) -> &Arc<[u32]> {
        &self.order
    }

    /// Behind the last row of each level in [`Forest::order`].
    pub fn level_ends(&self) -> &[u32] {
        &self.level_ends
    }

    /// The batches that are stepped, in the order of their rows.
    pub fn batches(&self) -> &[TreeBatch] {
        &self.batches
    }

    /// The trees, in the order of the scene.
    pub fn trees(&self) -> &[Planted] {
        &self.trees
    }

    /// The segments that are stepped in still air, with no leaves.
    pub fn at_rest(&self) -> Branches {
        let mut branches = Branches::zeroed(self.len());
        for &row in self.order.iter() {
            let row = row as usize;
            let segment = &self.segments[row];
            let parent = match segment.parent {
                NO_SEGMENT => Body::GROUND,
                parent => Body {
                    base: first_three(branches.base[parent as usize]),
                    pose: branches.pose[parent as usize].into(),
                    ..Body::GROUND
                },
            };
            let joint = Joint { turn: Quat::IDENTITY, rate: KernelVec3::ZERO };
            let body = segment_place(&segment.into(), &joint, &parent);
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
