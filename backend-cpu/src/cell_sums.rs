// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums over leaves in cells of the air. They are clear between steps, and no part of the state.

use std::marker::PhantomData;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

use bytemuck::Pod;
use windfall_core::device::leaf::burn::{BURN_WORDS, BurnSums};
use windfall_core::device::leaf::collide::{COLLISION_WORDS, CollisionSums};

/// Cells of the air in which leaves collide with each other.
pub(crate) type CollisionCells = CellSums<CollisionSums, { COLLISION_WORDS as usize }>;
/// Cells of the air that the heat of burning leaves goes to.
pub(crate) type HeatCells = CellSums<BurnSums, { BURN_WORDS as usize }>;

/// A table of cells with sums of a kind `S`, `WORDS` integers of which the first counts leaves.
#[derive(Debug)]
pub(crate) struct CellSums<S, const WORDS: usize> {
    words: Vec<AtomicU32>,
    /// Cells that are not clear.
    touched: Mutex<Vec<u32>>,
    sums: PhantomData<S>,
}

impl<S, const WORDS: usize> Default for CellSums<S, WORDS> {
    fn default() -> Self {
        Self { words: Vec::new(), touched: Mutex::default(), sums: PhantomData }
    }
}

impl<S: Pod, const WORDS: usize> CellSums<S, WORDS> {
    /// Makes room for so many cells, unless there is.
    pub(crate) fn make(&mut self, cells: usize) {
        self.words.resize_with(WORDS * cells, AtomicU32::default);
    }

    fn words_of(&self, index: u32) -> &[AtomicU32] {
        &self.words[index as usize * WORDS..][..WORDS]
    }

    /// Adds to a cell. Returns true if it was clear.
    pub(crate) fn add(&self, index: u32, sums: &S) -> bool {
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
    pub(crate) fn sums(&self, index: u32) -> S {
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
