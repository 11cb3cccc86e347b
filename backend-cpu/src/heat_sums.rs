// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums of the heat that leaves release, in cells of the air and for the fires that they feed. They are clear between steps, and no part of
//! the state.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

use windfall_core::device::leaf::burn::{BURN_CELL_BITS, BURN_WORDS, BurnSums};
use windfall_core::scene::MAX_PLUMES;

const WORDS: usize = BURN_WORDS as usize;

/// A table of cells, and a sum for each plume.
#[derive(Debug, Default)]
pub(crate) struct HeatSums {
    words: Vec<AtomicU32>,
    /// Cells that are not clear.
    touched: Mutex<Vec<u32>>,
    fires: [AtomicU32; MAX_PLUMES],
}

impl HeatSums {
    /// Makes room for cells, unless there is.
    pub(crate) fn make(&mut self) {
        self.words.resize_with(WORDS << BURN_CELL_BITS, AtomicU32::default);
    }

    fn words_of(&self, index: u32) -> &[AtomicU32] {
        &self.words[index as usize * WORDS..][..WORDS]
    }

    /// Adds to a cell. Returns true if it was clear.
    pub(crate) fn add(&self, index: u32, sums: &BurnSums) -> bool {
        let more: [u32; WORDS] = bytemuck::cast(*sums);
        // Integers: the order in which threads add them is of no matter.
        let mut before = more
            .into_iter()
            .zip(self.words_of(index))
            .map(|(more, word)| word.fetch_add(more, Ordering::Relaxed));
        let count = before.next();
        before.for_each(drop);
        count == Some(0)
    }

    /// Adds to the fire of a plume.
    pub(crate) fn feed(&self, plume: usize, power: u32) {
        self.fires[plume].fetch_add(power, Ordering::Relaxed);
    }

    /// Notes cells that were clear.
    pub(crate) fn list(&self, touched: &[u32]) {
        self.touched.lock().unwrap_or_else(PoisonError::into_inner).extend(touched);
    }

    /// Sums of a cell.
    pub(crate) fn sums(&self, index: u32) -> BurnSums {
        let mut sums = [0; WORDS];
        for (sum, word) in sums.iter_mut().zip(self.words_of(index)) {
            *sum = word.load(Ordering::Relaxed);
        }
        bytemuck::cast(sums)
    }

    /// Sums of the fires, which are clear from then on as all cells are.
    pub(crate) fn take(&self) -> [u32; MAX_PLUMES] {
        for index in self.touched.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            self.words_of(index).iter().for_each(|word| word.store(0, Ordering::Relaxed));
        }
        self.fires.each_ref().map(|fire| fire.swap(0, Ordering::Relaxed))
    }
}
