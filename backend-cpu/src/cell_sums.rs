// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums over leaves in cells of the air. They are clear between steps, and no part of the state.

use std::hint::black_box;
use std::marker::PhantomData;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use windfall_core::device::leaf::burn::{BURN_WORDS, BurnSums};
use windfall_core::device::leaf::collide::{COLLISION_WORDS, CollisionSums};

/// Pairs of words of the sums of leaves that collide.
const COLLISION_PAIRS: usize = COLLISION_WORDS as usize / 2;
/// Pairs of words of the sums of heat.
const BURN_PAIRS: usize = BURN_WORDS as usize / 2;

/// Cells of the air in which leaves collide with each other.
pub(crate) type CollisionCells = CellSums<CollisionSums, COLLISION_PAIRS>;
/// Cells of the air that the heat of burning leaves goes to.
pub(crate) type HeatCells = CellSums<BurnSums, BURN_PAIRS>;

/// Sums as pairs of words, the second in the upper half, to be added at once. The first of the first pair counts leaves. A sum of the first words does
/// not reach 2^32, or the sums are of no use.
pub(crate) trait WordPairs<const PAIRS: usize>: Copy {
    /// The pairs of sums.
    fn pairs(&self) -> [u64; PAIRS];
    /// The sums of pairs.
    fn of_pairs(pairs: [u64; PAIRS]) -> Self;
}

/// A pair of words.
fn pair(low: u32, high: u32) -> u64 {
    u64::from(low) | u64::from(high) << 32
}

/// The words of a pair.
#[expect(clippy::cast_possible_truncation, reason = "either half")]
fn words(pair: u64) -> [u32; 2] {
    [pair as u32, (pair >> 32) as u32]
}

/// Of up to [`MOST_COLLIDING`](windfall_core::device::leaf::collide::MOST_COLLIDING) leaves, sums that are never negative stay within 31 bits.
impl WordPairs<COLLISION_PAIRS> for CollisionSums {
    fn pairs(&self) -> [u64; COLLISION_PAIRS] {
        let [x, y, z] = [0, 1, 2].map(|axis| pair(self.place[axis], self.momentum[axis]));
        [pair(self.count, self.key), pair(self.weight, self.area), pair(self.energy, self.virial), x, y, z]
    }

    fn of_pairs(pairs: [u64; COLLISION_PAIRS]) -> Self {
        let [[count, key], [weight, area], [energy, virial], x, y, z] = pairs.map(words);
        let (place, momentum) = ([x[0], y[0], z[0]], [x[1], y[1], z[1]]);
        Self { count, key, weight, area, momentum, energy, place, virial }
    }
}

impl WordPairs<BURN_PAIRS> for BurnSums {
    fn pairs(&self) -> [u64; BURN_PAIRS] {
        [pair(self.count, self.key), pair(0, self.power)]
    }

    fn of_pairs(pairs: [u64; BURN_PAIRS]) -> Self {
        let [[count, key], [unused, power]] = pairs.map(words);
        Self { count, key, power, unused }
    }
}

/// Sums of a cell, in a cache line of its own.
#[derive(Debug)]
#[repr(align(64))]
struct Cell<const PAIRS: usize>([AtomicU64; PAIRS]);

impl<const PAIRS: usize> Default for Cell<PAIRS> {
    fn default() -> Self {
        Self([const { AtomicU64::new(0) }; PAIRS])
    }
}

/// A table of cells with sums of a kind `S`.
#[derive(Debug)]
pub(crate) struct CellSums<S, const PAIRS: usize> {
    cells: Vec<Cell<PAIRS>>,
    /// Cells that are not clear.
    touched: Mutex<Vec<u32>>,
    sums: PhantomData<S>,
}

impl<S, const PAIRS: usize> Default for CellSums<S, PAIRS> {
    fn default() -> Self {
        Self { cells: Vec::new(), touched: Mutex::default(), sums: PhantomData }
    }
}

impl<S: WordPairs<PAIRS>, const PAIRS: usize> CellSums<S, PAIRS> {
    /// Makes room for so many cells, unless there is.
    pub(crate) fn make(&mut self, cells: usize) {
        self.cells.resize_with(cells, Cell::default);
    }

    fn pairs_of(&self, index: u32) -> &[AtomicU64; PAIRS] {
        &self.cells[index as usize].0
    }

    /// Reads cells that are about to be needed, so that memory is waited for once and not for each.
    pub(crate) fn fetch(&self, cells: impl Iterator<Item = u32>) {
        let read = cells.map(|index| self.pairs_of(index)[0].load(Ordering::Relaxed));
        black_box(read.fold(0, |all, pair| all | pair));
    }

    /// Adds to a cell. Returns true if it was clear.
    pub(crate) fn add(&self, index: u32, sums: &S) -> bool {
        let mut before = sums.pairs().into_iter().zip(self.pairs_of(index)).map(|(more, pair)| {
            // Integers: the order in which threads add them is of no matter.
            pair.fetch_add(more, Ordering::Relaxed)
        });
        let count = before.next().map(|pair| words(pair)[0]);
        before.for_each(drop);
        count == Some(0)
    }

    /// Notes cells that were clear.
    pub(crate) fn list(&self, touched: &[u32]) {
        self.touched.lock().unwrap_or_else(PoisonError::into_inner).extend(touched);
    }

    /// Sums of a cell.
    pub(crate) fn sums(&self, index: u32) -> S {
        let mut pairs = [0; PAIRS];
        for (sum, pair) in pairs.iter_mut().zip(self.pairs_of(index)) {
            *sum = pair.load(Ordering::Relaxed);
        }
        S::of_pairs(pairs)
    }

    /// Clears those that have been noted.
    pub(crate) fn clear(&self) {
        for index in self.touched.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            self.pairs_of(index).iter().for_each(|pair| pair.store(0, Ordering::Relaxed));
        }
    }
}
