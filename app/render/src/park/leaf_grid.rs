// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves of a crown counted in cells, to know how much of the sky they leave open to one another.

use glam::{IVec3, Vec3};

/// Cells along each edge of the box around a crown.
const CELLS: i32 = 20;
/// Optical depth straight through a crown of average thickness: a leaf area index of about 4, whose leaves hide half of their area.
const DEPTH: f32 = 2.0;
/// Directions from which light of the sky comes.
const DIRECTIONS: [Vec3; 5] = [
    Vec3::Y,
    Vec3::new(0.8, 0.6, 0.0),
    Vec3::new(-0.8, 0.6, 0.0),
    Vec3::new(0.0, 0.6, 0.8),
    Vec3::new(0.0, 0.6, -0.8),
];

/// Leaves of a crown in cells.
pub(crate) struct LeafGrid {
    low_m: Vec3,
    cell_m: Vec3,
    /// Optical depth across each cell.
    depths: Vec<f32>,
}

impl LeafGrid {
    /// The grid of clusters of leaves of equal size at these places.
    pub(crate) fn new(places_m: &[Vec3]) -> Self {
        let bounds = |pick: fn(Vec3, Vec3) -> Vec3| places_m.iter().copied().reduce(pick).unwrap_or_default();
        let (low_m, high_m) = (bounds(Vec3::min), bounds(Vec3::max));
        let cell_m = ((high_m - low_m) / CELLS as f32).max(Vec3::splat(1.0e-3));
        let mut grid = Self { low_m, cell_m, depths: vec![0.0; (CELLS * CELLS * CELLS) as usize] };
        let mut columns = vec![false; (CELLS * CELLS) as usize];
        for &place in places_m {
            let cell = grid.cell(place).clamp(IVec3::ZERO, IVec3::splat(CELLS - 1));
            grid.depths[index(cell)] += 1.0;
            columns[(cell.x * CELLS + cell.z) as usize] = true;
        }
        let per_column =
            places_m.len() as f32 / columns.iter().filter(|&&is_filled| is_filled).count().max(1) as f32;
        grid.depths.iter_mut().for_each(|depth| *depth *= DEPTH / per_column);
        grid
    }

    fn cell(&self, place_m: Vec3) -> IVec3 {
        ((place_m - self.low_m) / self.cell_m).floor().as_ivec3()
    }

    /// Share of the light of the sky that reaches a place, 0 to 1.
    pub(crate) fn open(&self, place_m: Vec3) -> f32 {
        let through = |direction: Vec3| {
            let step = direction * self.cell_m.y;
            let mut depth = 0.0;
            for number in 1..=2 * CELLS {
                let cell = self.cell(place_m + step * number as f32);
                if cell.min_element() < 0 || cell.max_element() >= CELLS {
                    break;
                }
                depth += self.depths[index(cell)];
            }
            (-depth).exp()
        };
        DIRECTIONS.map(through).iter().sum::<f32>() / DIRECTIONS.len() as f32
    }
}

#[expect(clippy::cast_sign_loss, reason = "cells within the grid")]
fn index(cell: IVec3) -> usize {
    ((cell.y * CELLS + cell.x) * CELLS + cell.z) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn the_sky_is_open_above_a_crown_and_hidden_below_it() {
        let mut random = Random::new(1);
        let places: Vec<Vec3> =
            (0..4000).map(|_| Vec3::new(0.0, 8.0, 0.0) + 3.0 * random.in_ball()).collect();
        let grid = LeafGrid::new(&places);
        let at = |y: f32| grid.open(Vec3::new(0.0, y, 0.0));
        assert!(at(11.0) > 0.9, "on top: {}", at(11.0));
        assert!(
            at(10.0) > at(8.0) && at(8.0) > at(6.0),
            "deeper and deeper: {} {} {}",
            at(10.0),
            at(8.0),
            at(6.0)
        );
        assert!(at(5.2) < 0.35, "beneath: {}", at(5.2));
    }
}
