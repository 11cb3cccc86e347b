// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shards: parts of a world that are simulated apart, on other machines or one after another, and together are the whole to the bit.
//!
//! A shard has a run of the scene's slots of leaves and the trees that grow in it; trees that are stepped together stay together. The first
//! one has the particles besides.

use std::fmt;
use std::ops::Range;

use super::wind::MOST_INTERVAL_STEPS;
use crate::device::leaf::air::AIR_UNIT_SHIFT;
use crate::error::SceneError;
use crate::scene::Scene;
use crate::tree::Forest;
use crate::tree::batch::TreeBatch;

/// Slots from one that takes turns with others to the next in the same turn: a shard's rows begin at a multiple of it.
const ROW_STEP: u32 = MOST_INTERVAL_STEPS << AIR_UNIT_SHIFT;

/// One of several parts that the leaves of a scene are divided into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u32,
    count: u32,
}

impl Shard {
    /// The whole scene.
    pub const WHOLE: Self = Self { number: 1, count: 1 };

    /// The shard of this number, counted from 1, out of so many; `None` unless the number is among them.
    pub fn new(number: u32, count: u32) -> Option<Self> {
        (1..=count).contains(&number).then_some(Self { number, count })
    }

    /// Its number, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// Number of shards.
    pub fn count(self) -> u32 {
        self.count
    }

    /// Returns true if it is everything.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// Returns true if it is the first, which has what is not divided.
    pub fn is_first(self) -> bool {
        self.number == 1
    }

    /// Checks that a scene can be divided into so many.
    ///
    /// # Errors
    /// Names what its leaves share, or the number of shards if there are more of them than leaves.
    pub(crate) fn check(self, scene: &Scene) -> Result<(), SceneError> {
        if self.is_whole() {
            return Ok(());
        }
        let refuse = |field: &str, value: String, allowed: &str| {
            let (file, field, allowed) = (scene.name.clone(), field.into(), allowed.into());
            Err(SceneError::Field { file, field, value, allowed })
        };
        if scene.ground.litter.is_some() {
            return refuse(
                "ground.litter",
                "Some".into(),
                "None in shards: leaves of all shards would share it",
            );
        }
        if scene.weather.is_some() {
            return refuse(
                "weather",
                "Some".into(),
                "None in shards: trees of all shards would share the snow",
            );
        }
        if scene.leaves_burn() {
            return refuse(
                "species",
                "burns: Some".into(),
                "None in shards: leaves of all shards would share the fire",
            );
        }
        if self.count > scene.leaf_count().max(1) {
            let leaves = scene.leaf_count();
            return refuse("shard", self.to_string(), &format!("at most {leaves} shards, one for each leaf"));
        }
        Ok(())
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

/// Leaves and trees of a shard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShardRows {
    /// Slot of the first row of its leaves. Rows before its own slots hold nothing; they keep the turns of slots as they are in the whole.
    pub first_row: u32,
    /// Its slots.
    pub slots: Range<u32>,
    /// Its trees, by their number in the scene.
    pub trees: Range<usize>,
    /// Rows of their segments in the store of all.
    pub segments: Range<usize>,
    /// Their batches in the forest of the whole scene.
    pub(super) batches: Range<usize>,
}

impl ShardRows {
    /// The share of a shard of a scene with these trees.
    pub(super) fn of(shard: Shard, scene: &Scene, forest: &Forest) -> Self {
        let batches = forest.batches();
        let begin = |number: u32| {
            let leaves = u64::from(scene.leaf_count());
            let cut = leaves * u64::from(number) / u64::from(shard.count);
            #[expect(clippy::cast_possible_truncation, reason = "at most the number of leaves")]
            let cut = cut as u32;
            let before = match number {
                0 => 0,
                // The end of a batch that is nearest.
                _ => batches.partition_point(|batch| batch.slots.start.midpoint(batch.slots.end) <= cut),
            };
            let behind_trees = cut.max(scene.tree_leaf_count());
            (before, batches.get(before).map_or(behind_trees, |batch| batch.slots.start))
        };
        let ((first_batch, first), (end_batch, end)) = (begin(shard.number - 1), begin(shard.number));
        let row_of = |batch: usize| batches.get(batch).map_or(forest.len(), |batch| batch.first as usize);
        let tree_of =
            |batch: Option<&TreeBatch>| batch.map_or(forest.trees().len(), |batch| batch.trees.start);
        Self {
            first_row: if shard.is_whole() { 0 } else { first / ROW_STEP * ROW_STEP },
            slots: first..end,
            trees: tree_of(batches.get(first_batch))..tree_of(batches.get(end_batch)),
            segments: row_of(first_batch)..row_of(end_batch),
            batches: first_batch..end_batch,
        }
    }

    /// Number of rows of leaves, those that hold nothing included.
    pub fn leaf_rows(&self) -> u32 {
        self.slots.end - self.first_row
    }

    /// Number of the first rows that hold nothing.
    pub fn unused_rows(&self) -> u32 {
        self.slots.start - self.first_row
    }

    /// Rows of its leaves, each with its slot.
    pub fn leaves(&self) -> impl Iterator<Item = (usize, u32)> + use<> {
        (self.unused_rows() as usize..).zip(self.slots.clone())
    }

    /// Number of rows of leaves up to the last that a tree of the scene has.
    pub fn rows_on_trees(&self, tree_leaf_count: u32) -> u32 {
        tree_leaf_count.clamp(self.first_row, self.slots.end) - self.first_row
    }
}
