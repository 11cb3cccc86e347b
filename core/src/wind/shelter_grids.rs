// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The shelter tables of a scene: over everything that shelters, and where trees or hills make that a coarse one, a finer one around its solid things.

use super::bluff::{BluffWake, MOST_REVERSED, wake_heights};
use super::porous::{SLENDER_LENGTHS, SWAY_HEIGHTS, WAKE_HEIGHTS};
use super::shelter::{LEAST_BLUFF, STANDING_GAP, ShelterGrid, ShelterWind, SolidWakes, sheltering};
use crate::blocks::ShelterBlock;
use crate::convert::len32;
use crate::device::wind::shelter::SHELTER_LAYERS;
use crate::layout::Uint4;
use crate::scene::Scene;
use crate::solid::Solid;
use crate::tree::Forest;

/// Smallest cell in m where there are no solid things.
const LEAST_CELL_M: f64 = 1.0;
/// Smallest cell in m where there are.
const LEAST_SOLID_CELL_M: f64 = 0.25;
/// Smallest cell where there are, in heights of the lowest one that shelters.
const CELL_HEIGHTS: f64 = 0.25;
/// Most cells along an edge.
const MOST_CELLS: f64 = 192.0;
/// Top of the table relative to the height of the tallest tree.
const TOP_HEIGHTS: f64 = 2.0;
/// Numbers that a lack in the table may have.
const UNITS: f32 = 65_536.0;

/// The shelter tables of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShelterGrids {
    /// Over everything that shelters.
    whole: ShelterGrid,
    /// Over its solid things and their wakes, where that of the whole is coarser.
    near: Option<ShelterGrid>,
}

/// Rectangle and height that a table reaches, and its smallest cell.
#[derive(Clone, Copy, Debug)]
struct Extent {
    least_m: [f64; 2],
    most_m: [f64; 2],
    top_m: f64,
    least_cell_m: f64,
}

impl Extent {
    /// The extent of nothing.
    fn empty() -> Self {
        Self {
            least_m: [f64::INFINITY; 2],
            most_m: [f64::NEG_INFINITY; 2],
            top_m: 0.0,
            least_cell_m: LEAST_CELL_M,
        }
    }

    /// Includes a square around a place.
    fn include(&mut self, [x_m, z_m]: [f64; 2], reach_m: f64) {
        for (axis, at_m) in [x_m, z_m].into_iter().enumerate() {
            self.least_m[axis] = self.least_m[axis].min(at_m - reach_m);
            self.most_m[axis] = self.most_m[axis].max(at_m + reach_m);
        }
    }

    /// Includes trees and the wakes that they may have.
    fn include_trees(&mut self, forest: &Forest) {
        for tree in forest.trees() {
            let tall_m = f64::from(tree.skeleton.height_m());
            let ends = tree.skeleton.segments.iter().map(|segment| segment.end_m.as_dvec3());
            let rim_m = ends.map(|end| libm::hypot(end.x, end.z)).fold(0.0, f64::max);
            let reach_m = rim_m + (WAKE_HEIGHTS + SWAY_HEIGHTS) * tall_m;
            self.include([tree.foot_m.x, tree.foot_m.z].map(f64::from), reach_m + LEAST_CELL_M);
            self.top_m = self.top_m.max(TOP_HEIGHTS * tall_m);
        }
    }

    /// Includes solid things and the wakes that they may have.
    fn include_solids(&mut self, solids: &[Solid]) {
        for outline in sheltering(solids) {
            // One that stands on the ground may reach up higher by its gap.
            let tall_m = (1.0 + STANDING_GAP) * outline.height_m();
            let middle_m = outline.middle_m();
            let rims = outline.points.iter().map(|at| libm::hypot(at.x - middle_m.x, at.z - middle_m.z));
            let rim_m = rims.fold(0.0, f64::max);
            let wide_m = 2.0 * rim_m;
            let bluff_m = tall_m * wake_heights(wide_m / outline.height_m());
            let slender_m = SLENDER_LENGTHS * libm::sqrt(wide_m * tall_m);
            let reach_m = if wide_m < LEAST_BLUFF * tall_m { slender_m } else { bluff_m };
            self.include([middle_m.x, middle_m.z], rim_m + reach_m + LEAST_CELL_M);
            self.top_m = self.top_m.max(TOP_HEIGHTS * tall_m);
            self.least_cell_m = self.least_cell_m.min(CELL_HEIGHTS * tall_m);
        }
    }

    /// The grid over it, a unit of whose table stands for such a lack of wind; `None` if it includes nothing.
    fn grid(&self, lack_unit: f32) -> Option<ShelterGrid> {
        if self.top_m <= 0.0 {
            return None;
        }
        let edges = [self.most_m[0] - self.least_m[0], self.most_m[1] - self.least_m[1]];
        let cell_m = (edges[0].max(edges[1]) / MOST_CELLS).max(self.least_cell_m.max(LEAST_SOLID_CELL_M));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to MOST_CELLS")]
        let cells = edges.map(|edge_m| (libm::ceil(edge_m / cell_m).clamp(1.0, MOST_CELLS)) as usize);
        Some(ShelterGrid {
            west_m: self.least_m[0],
            north_m: self.least_m[1],
            cell_m,
            cells,
            layer_m: self.top_m / f64::from(SHELTER_LAYERS),
            lack_unit,
        })
    }
}

impl ShelterGrids {
    /// The grids of a scene: around its trees and solid things and the wakes that they may have, and around the hills' square. `None` if the
    /// scene has none of them.
    pub fn of(scene: &Scene, solids: &[Solid], forest: &Forest) -> Option<Self> {
        let (mut whole, mut near) = (Extent::empty(), Extent::empty());
        near.include_solids(solids);
        whole.include_solids(solids);
        whole.include_trees(forest);
        if let Some(terrain) = scene.ground.terrain {
            whole.include([0.0; 2], 0.5 * f64::from(terrain.edge_m));
            whole.top_m = whole.top_m.max(terrain.relief_m.into());
        }
        // Before solid things the wind turns back.
        let most_lack = if near.top_m > 0.0 { 1.0 + MOST_REVERSED } else { 1.0 };
        let whole = whole.grid(most_lack / UNITS)?;
        let near = near.grid(most_lack / UNITS);
        let near = near.filter(|near| near.cell_m < whole.cell_m || near.layer_m < whole.layer_m);
        Some(Self { whole, near })
    }

    /// Share of the mean wind that a unit of the tables lacks.
    pub fn lack_unit(&self) -> f32 {
        self.whole.lack_unit
    }

    /// Number of rows of both tables.
    pub fn row_count(&self) -> usize {
        self.whole.row_count() + self.near.as_ref().map_or(0, ShelterGrid::row_count)
    }

    /// The grids as kernels read them, switched off, with the tables from that row on.
    pub fn blocks(&self, first_row: u32) -> [ShelterBlock; 2] {
        let near_row = first_row + len32(self.whole.row_count());
        let near = self.near.as_ref().map(|near| near.block(near_row));
        [self.whole.block(first_row), near.unwrap_or_else(bytemuck::Zeroable::zeroed)]
    }

    /// The tables for a wind over ground of these heights, one behind the other: for every cell of every layer the lack of wind at its corners,
    /// along x and then along z, below and above.
    pub fn rows(
        &self,
        scene: &Scene,
        solids: &[Solid],
        forest: &Forest,
        wind: &ShelterWind,
        ground_height_m: impl Fn(f64, f64) -> f64 + Sync,
    ) -> Vec<Uint4> {
        let lacks = |grid: &ShelterGrid| grid.lacks(scene, solids, forest, wind, &ground_height_m);
        // The wind is free at the edges and at the top, and so it is beyond them.
        let mut whole = lacks(&self.whole);
        self.whole.set_rim(&mut whole, |_, _| 0.0);
        let mut rows = self.whole.rows(&whole);
        if let Some(near) = &self.near {
            let mut lacks = lacks(near);
            near.set_rim(&mut lacks, |place_m, above_m| self.whole.lack_at(&whole, place_m, above_m));
            rows.extend(near.rows(&lacks));
        }
        rows
    }

    /// Depths of snow in m that fill the wakes of solid things at places, x and z in m; zero where there are none. Trees shelter however deep it lies.
    pub fn filled_m(
        &self,
        solids: &[Solid],
        wind: &ShelterWind,
        ground_height_m: impl Fn(f64, f64) -> f64,
        places_m: impl Iterator<Item = [f64; 2]>,
    ) -> Vec<f64> {
        let finest = self.near.as_ref().unwrap_or(&self.whole);
        let wakes = SolidWakes::of(solids, finest, wind, &ground_height_m).bluff;
        let reaches: Vec<_> = wakes.iter().map(BluffWake::reach_m).collect();
        let filled_m = |[x_m, z_m]: [f64; 2]| {
            let place = wind.frame(x_m, z_m);
            let reach = |reach: &[[f64; 2]; 2]| {
                (0..2).all(|axis| (reach[axis][0]..reach[axis][1]).contains(&place[axis]))
            };
            let near = wakes.iter().zip(&reaches).filter(|(_, reaches)| reach(reaches));
            near.map(|(wake, _)| wake.filled_m(place)).fold(0.0, f64::max)
        };
        places_m.map(filled_m).collect()
    }
}
