// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cells of the air in which leaves collide with each other. They are clear between steps, and no part of the state.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

use windfall_core::device::leaf::collide::{COLLISION_CELL_BITS, COLLISION_WORDS, CollisionSums};

const WORDS: usize = COLLISION_WORDS as usize;

/// A table of cells.
#[derive(Debug, Default)]
pub(crate) struct CollisionCells {
    words: Vec<AtomicU32>,
    /// Cells that are not clear.
    touched: Mutex<Vec<u32>>,
}

impl CollisionCells {
    /// Clear cells.
    pub(crate) fn new() -> Self {
        let words = (0..WORDS << COLLISION_CELL_BITS).map(|_| AtomicU32::new(0)).collect();
        Self { words, touched: Mutex::default() }
    }

    /// Returns true before any have been made.
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    fn words_of(&self, index: u32) -> &[AtomicU32] {
        &self.words[index as usize * WORDS..][..WORDS]
    }

    /// Adds to a cell. Returns true if it was clear.
    pub(crate) fn add(&self, index: u32, sums: &CollisionSums) -> bool {
        let more: [u32; WORDS] = bytemuck::cast(*sums);
        let mut before = more.into_iter().zip(self.words_of(index)).map(|(more, word)| {
            // Integers: the order in which threads add them is of no matter.
            word.fetch_add(more, Ordering::Relaxed)
        });
        let count = before.next();
        before.for_each(drop);
        count == Some(0)
    }

    /// Notes cells that were clear.
    pub(crate) fn list(&self, touched: &[u32]) {
        self.touched.lock().unwrap_or_else(PoisonError::into_inner).extend(touched);
    }

    /// Sums of a cell.
    pub(crate) fn sums(&self, index: u32) -> CollisionSums {
        let mut sums = [0; WORDS];
        for (sum, word) in sums.iter_mut().zip(self.words_of(index)) {
            *sum = word.load(Ordering::Relaxed);
        }
        bytemuck::cast(sums)
    }

    /// Clears those that have been noted.
    pub(crate) fn clear(&self) {
        for index in self.touched.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            self.words_of(index).iter().for_each(|word| word.store(0, Ordering::Relaxed));
        }
    }
}
