// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums of the heat that leaves release, in cells of the air and for the fires that they feed.

use std::sync::atomic::{AtomicU32, Ordering};

use windfall_core::scene::MAX_PLUMES;

use crate::cell_sums::HeatCells;

/// A table of cells, and a sum for each plume.
#[derive(Debug, Default)]
pub(crate) struct HeatSums {
    pub(crate) cells: HeatCells,
    fires: [AtomicU32; MAX_PLUMES],
}

impl HeatSums {
    /// Adds to the fire of a plume.
    pub(crate) fn feed(&self, plume: usize, power: u32) {
        self.fires[plume].fetch_add(power, Ordering::Relaxed);
    }

    /// Sums of the fires, which are clear from then on as all cells are.
    pub(crate) fn take(&self) -> [u32; MAX_PLUMES] {
        self.cells.clear();
        self.fires.each_ref().map(|fire| fire.swap(0, Ordering::Relaxed))
    }
}
