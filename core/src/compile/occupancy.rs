// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the occupancy grid of the solid parts that stand still: a bit for each cell that one of them comes near.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::solids::{core_of, extent_m, rows_of_words};
use crate::blocks::SolidsBlock;
use crate::convert::{len32, single, word};
use crate::device::solid::near::OCCUPIED_WITHIN_M;
use crate::layout::Uint4;
use crate::solid::faces::Faces;
use crate::solid::{Solid, SolidPose};

/// Edge in m of the smallest cells.
const CELL_M: f64 = 0.25;
/// Most cells: a quarter of a megabyte of bits.
const MOST_CELLS: f64 = 2_097_152.0;
/// Most cells of which the distance from a part is computed.
const MOST_DISTANCES: f64 = 8.0 * MOST_CELLS;
/// Distance in m by which kernels, which compute in single precision, may take a place for one in the next cell.
const ROUNDING_M: f64 = 0.01;

/// A part that stands still, and the box in m within which cells are near it.
struct Occupant<'a> {
    solid: &'a Solid,
    pose: SolidPose,
    low_m: DVec3,
    high_m: DVec3,
}

impl<'a> Occupant<'a> {
    fn of(solid: &'a Solid) -> Self {
        let pose = solid.pose_at(0.0, |_, _| 0.0);
        let [low, high] = extent_m(solid, &pose);
        let beyond = DVec3::splat(f64::from(OCCUPIED_WITHIN_M) + ROUNDING_M);
        Self { solid, pose, low_m: low - beyond, high_m: high + beyond }
    }

    /// Distance in m that the part is away from a place in its box at least.
    fn clearance_m(&self, place: DVec3) -> f64 {
        let inner = self.pose.turn.inverse() * (place - self.pose.center_m);
        match &self.solid.faces {
            Some(Faces::Convex(_, planes)) => {
                planes.iter().map(|plane| plane.normal.dot(inner) - plane.offset_m).fold(f64::MIN, f64::max)
            }
            // As its box.
            Some(Faces::Mesh(..)) => f64::MIN,
            None => {
                let (half_m, rounding_m, is_round) = core_of(&self.solid.shape);
                let half_m = half_m.as_dvec3();
                let beyond = if is_round {
                    DVec3::new(libm::hypot(inner.x, inner.z) - half_m.x, inner.y.abs() - half_m.y, 0.0)
                } else {
                    inner.abs() - half_m
                };
                beyond.max(DVec3::ZERO).length() - f64::from(rounding_m)
            }
        }
    }
}

/// Appends the grid to the tables, and says where. Its cells are as large as it takes to keep them few.
pub(super) fn tabulate_occupancy<'a>(
    still: impl Iterator<Item = &'a Solid>,
    solids: &mut SolidsBlock,
    tables: &mut Vec<Uint4>,
) {
    let occupants: Vec<Occupant<'_>> = still.map(Occupant::of).collect();
    solids.first_occupancy_row = len32(tables.len());
    if occupants.is_empty() {
        tables.push(Uint4::default());
        return;
    }
    let low_m = occupants.iter().map(|part| part.low_m).fold(DVec3::INFINITY, DVec3::min);
    let high_m = occupants.iter().map(|part| part.high_m).fold(DVec3::NEG_INFINITY, DVec3::max);
    let mut cell_m = CELL_M;
    let sides = loop {
        let cells = |span_m: DVec3| (span_m / cell_m).ceil().max(DVec3::ONE);
        let sides = cells(high_m - low_m);
        let distances =
            occupants.iter().map(|part| (cells(part.high_m - part.low_m) + 1.0).element_product());
        if sides.element_product() <= MOST_CELLS && distances.sum::<f64>() <= MOST_DISTANCES {
            break sides;
        }
        cell_m *= 2.0;
    };
    let grid = Grid { low_m, cell_m, sides: sides.to_array().map(word) };
    solids.occupancy_low_m = low_m.to_array().map(single);
    solids.occupancy_cells_per_m = single(1.0 / cell_m);
    [solids.occupancy_columns, solids.occupancy_layers, solids.occupancy_lines] = grid.sides;
    tables.extend(rows_of_words(&grid.bits(&occupants)));
}

/// Cells, and how many there are along x, y and z.
struct Grid {
    low_m: DVec3,
    cell_m: f64,
    sides: [u32; 3],
}

impl Grid {
    /// A bit for each cell, upwards first, then along x: set where a part comes near.
    fn bits(&self, occupants: &[Occupant<'_>]) -> Vec<u32> {
        let [columns, layers, lines] = self.sides;
        let mut bits = vec![0; (columns * layers * lines).div_ceil(u32::BITS) as usize];
        let near_m = f64::from(OCCUPIED_WITHIN_M) + ROUNDING_M + 0.5 * libm::sqrt(3.0) * self.cell_m;
        for part in occupants {
            let [from, to] = [part.low_m, part.high_m].map(|end_m| (end_m - self.low_m) / self.cell_m);
            let along = |axis: usize| cells_between(from[axis], to[axis], self.sides[axis]);
            for line in along(2) {
                for column in along(0) {
                    for layer in along(1) {
                        let middle = DVec3::new(column.into(), layer.into(), line.into()) + 0.5;
                        if part.clearance_m(self.low_m + middle * self.cell_m) <= near_m {
                            let cell = (line * columns + column) * layers + layer;
                            bits[(cell / u32::BITS) as usize] |= 1 << (cell % u32::BITS);
                        }
                    }
                }
            }
        }
        bits
    }
}

/// Cells of a row of so many that a stretch of it, in cells, touches.
fn cells_between(from: f64, to: f64, count: u32) -> RangeInclusive<u32> {
    let [first, last] = [from, to].map(|end| word(libm::floor(end).clamp(0.0, f64::from(count - 1))));
    first..=last
}
