// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Kept moments of a world, from which earlier steps are reached again to the bit.

use std::collections::BTreeMap;

use windfall_core::World;

/// Memory that kept moments may take, in bytes.
const BUDGET_BYTES: usize = 128 << 20;
/// Most moments, however small.
const MOST: usize = 128;
/// Steps between two moments at first.
const FIRST_SPACING: u32 = 30;

/// Moments at equal distances, which doubles whenever they become too many.
#[derive(Debug)]
pub(crate) struct History {
    moments: BTreeMap<u32, World>,
    most: usize,
    spacing: u32,
}

impl History {
    /// A past that begins with `world`, which is always kept.
    pub(crate) fn new(world: &World) -> Self {
        let most = (BUDGET_BYTES / world.state_bytes().max(1)).clamp(1, MOST);
        let moments = BTreeMap::from([(world.clock.step(), world.clone())]);
        Self { moments, most, spacing: FIRST_SPACING }
    }

    /// Steps from `step` on until a moment is to be kept.
    pub(crate) fn until_next(&self, step: u32) -> u32 {
        self.spacing - step % self.spacing
    }

    /// Keeps this moment if it is due.
    pub(crate) fn reach(&mut self, world: &World) {
        let step = world.clock.step();
        if self.most > 1 && step.is_multiple_of(self.spacing) && !self.moments.contains_key(&step) {
            self.moments.insert(step, world.clone());
            while self.moments.len() > self.most {
                self.spacing = self.spacing.saturating_mul(2);
                let spacing = self.spacing;
                self.moments.retain(|step, _| step.is_multiple_of(spacing));
            }
        }
    }

    /// The last moment at or before `step`.
    pub(crate) fn before(&self, step: u32) -> Option<&World> {
        self.moments.range(..=step).next_back().map(|(_, world)| world)
    }
}
