// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The hills of a scene in metres.

use super::subdivision::HeightGrid;
use crate::layout::Uint4;
use crate::scene::Terrain;

/// Heights on a square grid that repeats in both directions, from the origin on.
#[derive(Clone, Debug, PartialEq)]
pub struct Hills {
    /// Cells along an edge, a power of two.
    pub cells: u32,
    /// Edge of a cell in metres.
    pub cell_m: f32,
    /// Heights in metres above the ground at the origin, row by row along x.
    pub heights_m: Vec<f32>,
}

impl Hills {
    /// The hills that a scene describes; always the same.
    pub fn grow(terrain: &Terrain) -> Self {
        let grid = HeightGrid::grow(terrain);
        let lowest = grid.heights.iter().copied().min().unwrap_or(0);
        let highest = grid.heights.iter().copied().max().unwrap_or(0);
        #[expect(clippy::cast_precision_loss, reason = "heights are rounded to single precision in any case")]
        let per_unit = f64::from(terrain.relief_m) / ((highest - lowest).max(1) as f64);
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            reason = "kernels work in single precision"
        )]
        let metres = |height: &i64| (((height - grid.at(0, 0)) as f64) * per_unit) as f32;
        let cells = 1 << terrain.levels;
        let heights_m = grid.heights.iter().map(metres).collect();
        Self { cells, cell_m: terrain.edge_m / cells as f32, heights_m }
    }

    /// Height of a grid point; beyond an edge the grid begins again.
    pub fn at(&self, x: i64, z: i64) -> f32 {
        let mask = i64::from(self.cells) - 1;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "masked to the grid")]
        let index = (((z & mask) << self.cells.trailing_zeros()) | (x & mask)) as usize;
        self.heights_m[index]
    }

    /// Height at any place, interpolated linearly in each direction.
    pub fn height_m(&self, x_m: f32, z_m: f32) -> f32 {
        let (u, v) = (x_m / self.cell_m, z_m / self.cell_m);
        #[expect(clippy::cast_possible_truncation, reason = "places lie within a few million cells")]
        let (x, z) = (u.floor() as i64, v.floor() as i64);
        let (tu, tv) = (u - u.floor(), v - v.floor());
        let along = |z: i64| self.at(x, z) + tu * (self.at(x + 1, z) - self.at(x, z));
        along(z) + tv * (along(z + 1) - along(z))
    }

    /// Table for kernels: for every cell the heights of its corners, x running fastest.
    pub(crate) fn rows(&self) -> Vec<Uint4> {
        let cells = i64::from(self.cells);
        let word = |x: i64, z: i64| self.at(x, z).to_bits();
        let row = |x: i64, z: i64| Uint4([word(x, z), word(x + 1, z), word(x, z + 1), word(x + 1, z + 1)]);
        (0..cells).flat_map(|z| (0..cells).map(move |x| (x, z))).map(|(x, z)| row(x, z)).collect()
    }
}
