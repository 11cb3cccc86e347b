// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Report of the trees of a scene during a run.

use serde::{Deserialize, Serialize};
use windfall_core::World;
use windfall_core::tree::SwayExtent;

/// Samples of the trees in a run, at evenly spaced steps; the last is at its end.
const LOOKS: u32 = 16;

/// The trees of a scene in a run. The names of these fields are keys of the report's JSON; they stay.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct TreeReport {
    /// Trees.
    pub count: usize,
    /// Segments of all trees.
    pub segments: usize,
    /// Largest angle of a joint away from rest, at the start of the run and at sixteen evenly spaced steps of it.
    pub max_joint_angle_rad: f64,
    /// Largest speed of an upper end of a segment at the same steps.
    pub tip_speed_max_m_s: f64,
    /// Leaves that have come off in the run; one that grew back and came off again counts again.
    pub leaves_shed: u64,
}

/// Follows the trees through a run.
#[derive(Debug)]
pub(crate) struct Swaying {
    falls: u64,
    extent: SwayExtent,
    steps: u32,
    looks: u32,
}

/// Findings on the trees in part of a run.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct KeptSwaying {
    falls: u64,
    /// Bits of the largest angle of a joint and of the largest speed: a number in words may lose some.
    extent_bits: [u64; 2],
    looks: u32,
}

impl Swaying {
    /// A run of so many steps begins with this state.
    pub(crate) fn new(world: &World, steps: u32) -> Self {
        let looks = if world.compiled.forest().is_empty() { LOOKS } else { 0 };
        Self { falls: falls(world), extent: extent(world), steps, looks }
    }

    /// Goes on with a run of so many steps.
    pub(crate) fn go_on(kept: KeptSwaying, steps: u32) -> Self {
        let [joint_angle_rad, tip_speed_m_s] = kept.extent_bits.map(f64::from_bits);
        let extent = SwayExtent { joint_angle_rad, tip_speed_m_s };
        Self { falls: kept.falls, extent, steps, looks: kept.looks }
    }

    /// The same, to be kept.
    pub(crate) fn keep(&self) -> KeptSwaying {
        let extent = [self.extent.joint_angle_rad, self.extent.tip_speed_m_s];
        KeptSwaying { falls: self.falls, extent_bits: extent.map(f64::to_bits), looks: self.looks }
    }

    /// Steps to the next sample, with so many left; `None` if the end is sampled anyway.
    pub(crate) fn wait(&self, left: u32) -> Option<u32> {
        let done = self.steps - left;
        let next = (u64::from(self.steps) * u64::from(self.looks + 1) / u64::from(LOOKS)).try_into();
        next.ok().filter(|_| self.looks + 1 < LOOKS).map(|next: u32| next.saturating_sub(done))
    }

    /// Samples the trees.
    pub(crate) fn look(&mut self, world: &World) {
        self.looks += 1;
        self.extent = self.extent.or(extent(world));
    }

    /// The report, with the state at the end.
    pub(crate) fn finish(&self, world: &World) -> TreeReport {
        let extent = self.extent.or(extent(world));
        TreeReport {
            count: world.compiled.shard_rows().trees.len(),
            segments: world.compiled.shard_rows().segments.len(),
            max_joint_angle_rad: extent.joint_angle_rad,
            tip_speed_max_m_s: extent.tip_speed_m_s,
            leaves_shed: falls(world).saturating_sub(self.falls),
        }
    }
}

fn extent(world: &World) -> SwayExtent {
    SwayExtent::of(world.compiled.forest(), &world.branches)
}

/// Number of times that leaves of trees have come off since the beginning: each time, a leaf's number rises by the number of
/// all slots.
fn falls(world: &World) -> u64 {
    let scene = world.compiled.scene();
    let (slots, of_trees) = (scene.leaf_count(), scene.tree_leaf_count());
    let of_trees = world.compiled.shard_rows().rows_on_trees(of_trees) as usize;
    let numbers = world.leaves.identity.iter().take(of_trees);
    numbers.map(|identity| u64::from(identity.id / slots)).sum()
}
