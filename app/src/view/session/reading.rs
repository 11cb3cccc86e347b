// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading the state of a running scene.

use std::time::{Duration, Instant};

use windfall_core::leaf::Leaves;
use windfall_core::particle::ParticleStore;
use windfall_core::{CompiledScene, SimError, Simulator, Stats, World};

use super::Session;

/// Time between two counts of all leaves: counting waits for the device.
const COUNT_EVERY: Duration = Duration::from_millis(250);

impl Session {
    /// Counts over all leaves, at most a few times a second old.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn stats(&mut self) -> Result<Stats, SimError> {
        let is_old = self.counted.is_none_or(|counted| counted.elapsed() >= COUNT_EVERY);
        if is_old && self.stats.step != self.backend.clock().step() || self.counted.is_none() {
            self.stats = self.backend.stats()?;
            self.counted = Some(Instant::now());
        }
        Ok(self.stats)
    }

    /// The whole state as it is now.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn world(&mut self) -> Result<World, SimError> {
        let mut world = World::zeroed(self.compiled.clone(), self.backend.clock());
        self.backend.read_state(&mut world)?;
        Ok(world)
    }

    /// The compiled scene, as it is now.
    pub(crate) fn compiled(&self) -> &CompiledScene {
        &self.compiled
    }

    /// Heights of the litter a while before `step`, as they are kept.
    pub(crate) fn litter_before(&self, step: u32) -> &[u32] {
        self.history.litter_before(step)
    }

    /// The leaves as they are now, if they need not be brought from a device.
    pub(crate) fn host_leaves(&self) -> Option<&Leaves> {
        self.backend.host_leaves()
    }

    /// The particles as they are now, if they need not be brought from a device.
    pub(crate) fn host_particles(&self) -> Option<&ParticleStore> {
        self.backend.host_particles()
    }
}
