// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hills by midpoint subdivision, in integers: the same on every machine.
//!
//! The square is a torus, so the hills repeat without a seam. Halving a side at its mean and then smoothing with the
//! binomial filter is the subdivision of uniform cubic B-splines (Lane and Riesenfeld, 1980): one pass after every
//! halving leaves no crease of a coarse level in the finished surface, as a filter applied only to the finest would.

use crate::arith::rng::{philox, seed_words, triangular};
use crate::scene::Terrain;

/// Offset of the corners. Every halving takes two bits of the means, every smoothing four.
const ONE: i64 = 1 << 40;
/// Random words of a point.
const STREAM_POINT: u32 = 37;

/// Heights on a square grid that repeats, row by row along x.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeightGrid {
    /// Points along an edge, a power of two.
    pub size: usize,
    /// Heights in units of which the corners' offset is 2^40.
    pub heights: Vec<i64>,
}

impl HeightGrid {
    /// Height of a point; beyond the edge the grid begins again.
    pub fn at(&self, x: usize, z: usize) -> i64 {
        self.heights[(z & (self.size - 1)) * self.size + (x & (self.size - 1))]
    }

    /// The grid with a height for every point.
    fn of(size: usize, mut height: impl FnMut(usize, usize) -> i64) -> Self {
        let heights = (0..size * size).map(|index| height(index % size, index / size)).collect();
        Self { size, heights }
    }

    /// Two squares each way, each with two opposite corners offset upwards.
    fn corners(terrain: &Terrain) -> Self {
        Self::of(2, |x, z| if x == z { 0 } else { raise(random_of(terrain, x, z, 1)[2], 1) })
    }

    /// The grid with every square cut in four, new points at the means of the old ones about them.
    pub fn halved(&self) -> Self {
        Self::of(2 * self.size, |x, z| {
            let (west, north) = (x / 2, z / 2);
            let (east, south) = (west + (x & 1), north + (z & 1));
            let ends = self.at(west, north) + self.at(east, north);
            (ends + self.at(west, south) + self.at(east, south)) >> 2
        })
    }

    /// The grid with the little and the big offsets of the points that a halving has made.
    fn offset(mut self, terrain: &Terrain, level: u32) -> Self {
        let noise = whole(f64::from(terrain.noise) * 65536.0);
        let pulled = whole(f64::from(terrain.pulled) * 4_294_967_296.0);
        for (index, height) in self.heights.iter_mut().enumerate() {
            let (x, z) = (index % self.size, index / self.size);
            if (x | z) & 1 == 0 {
                continue;
            }
            let words = random_of(terrain, x, z, level);
            *height += ((i64::from(triangular(words[0])) * noise) << 8) >> (level - 1);
            if i64::from(words[1]) < pulled {
                *height += raise(words[2], level);
            }
        }
        self
    }

    /// The grid with every point at the mean of itself and its neighbours, weighted 1, 2, 1 in each direction.
    pub fn smoothed(&self) -> Self {
        let last = self.size - 1;
        let along = |x: usize, z: usize| self.at(x + last, z) + 2 * self.at(x, z) + self.at(x + 1, z);
        Self::of(self.size, |x, z| (along(x, z + last) + 2 * along(x, z) + along(x, z + 1)) >> 4)
    }

    /// The grid that a scene's hills are made from.
    pub fn grow(terrain: &Terrain) -> Self {
        let mut grid = Self::corners(terrain);
        for level in 2..=terrain.levels {
            grid = grid.halved().offset(terrain, level);
            for _ in 0..terrain.smoothing {
                grid = grid.smoothed();
            }
        }
        grid
    }
}

/// An upward offset at a level, half to all of its largest.
fn raise(word: u32, level: u32) -> i64 {
    ((ONE >> 1) + (i64::from(word >> 17) << 24)) >> (level - 1)
}

/// Nearest whole number of a small positive one.
#[expect(clippy::cast_possible_truncation, reason = "within the range that scenes are checked for")]
fn whole(value: f64) -> i64 {
    libm::round(value) as i64
}

/// The random words of a point of a level.
#[expect(clippy::cast_possible_truncation, reason = "grids have at most 512 points along an edge")]
fn random_of(terrain: &Terrain, x: usize, z: usize, level: u32) -> [u32; 4] {
    philox(seed_words(terrain.seed), [x as u32, z as u32, level, STREAM_POINT])
}

#[cfg(test)]
mod tests;
