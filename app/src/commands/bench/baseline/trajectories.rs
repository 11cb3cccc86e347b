// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A trajectory for every leaf, computed before the first frame and played back on the processor.
//!
//! # Source
//! The approach that Li et al., "GPU based real-time simulation of massive falling leaves" (2015), compare theirs to.

use windfall_core::leaf::{Attitude, Leaves, Place};
use windfall_core::{SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Length of a trajectory in seconds: a fall from the crown of a high tree.
const LENGTH_S: f32 = 20.0;

/// Leaves that own their whole way.
#[derive(Clone, Debug)]
pub(crate) struct Trajectories {
    leaves: Leaves,
    /// Leaf after leaf, frame after frame.
    frames: Vec<(Place, Attitude)>,
    length: usize,
    now: usize,
}

impl Trajectories {
    /// Frames of one trajectory at a step length in seconds.
    pub(crate) fn length(dt_s: f32) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few thousand at most")]
        let frames = (LENGTH_S / dt_s).ceil() as usize;
        frames
    }

    /// Bytes of one leaf: its trajectory and what is drawn of it.
    pub(crate) fn leaf_bytes(dt_s: f32) -> usize {
        (Self::length(dt_s) + 1) * size_of::<(Place, Attitude)>()
    }

    /// Records the trajectories of a world.
    ///
    /// # Errors
    /// [`SimError::Device`] if threads cannot be started.
    pub(crate) fn record(world: &World) -> Result<Self, SimError> {
        let length = Self::length(world.clock.dt_s());
        let mut simulator = CpuSimulator::new(world, CpuOptions::default())?;
        let mut frames = vec![(Place::default(), Attitude::default()); world.leaves.len() * length];
        for frame in 0..length {
            simulator.step(1)?;
            let leaves = &simulator.world().leaves;
            for (slot, trajectory) in frames.chunks_exact_mut(length).enumerate() {
                trajectory[frame] = (leaves.place[slot], leaves.attitude[slot]);
            }
        }
        Ok(Self { leaves: world.leaves.clone(), frames, length, now: 0 })
    }

    /// Plays `count` frames; after the last one the first comes again.
    pub(crate) fn step(&mut self, count: u32) {
        for _ in 0..count {
            for (slot, trajectory) in self.frames.chunks_exact(self.length).enumerate() {
                (self.leaves.place[slot], self.leaves.attitude[slot]) = trajectory[self.now];
            }
            self.now = (self.now + 1) % self.length;
        }
    }

    /// The leaves as they are drawn.
    pub(crate) fn leaves(&self) -> &Leaves {
        &self.leaves
    }
}
