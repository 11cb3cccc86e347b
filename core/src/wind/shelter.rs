// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The shelter table: the share of the mean wind that is left behind trees, hills and solid things, on a level grid.
//!
//! # Model
//! Trees have the wakes of [`PorousWake`], solid things that stand on the ground and are at least half as wide as high those of [`BluffWake`].
//! Slender ones, and those above the ground, have wakes as trees do, as far as the table reaches up. Those that move have none.
//!
//! A wake begins behind the rim, so that no tree shelters itself. Wakes multiply: each takes its share of the wind that arrives, so the order
//! of the trees does not matter. Air turns back nowhere but at the foot of what stands in its way. Turbulence is left as it is.
//!
//! What lies below a line that falls at 15° from higher ground upwind is sheltered: the shadow zone of Werner's model of dunes ("Eolian
//! dunes: computer simulations and attractor interpretation", 1995). How much wind is left there is an assumption.

use std::ops::Range;

use super::bluff::{BluffWake, Footprint, MOST_REVERSED, wake_heights};
use super::porous::{PorousWake, SLENDER_LENGTHS, SWAY_HEIGHTS, WAKE_HEIGHTS};
use crate::blocks::ShelterBlock;
use crate::convert::{single, word};
use crate::device::wind::shelter::SHELTER_LAYERS;
use crate::layout::Uint4;
use crate::scene::Scene;
use crate::solid::{Outline, Solid};
use crate::threads::each;
use crate::tree::Forest;

/// Heights of the table: one more than its layers.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
const LEVELS: usize = SHELTER_LAYERS as usize + 1;
/// Smallest cell in m where there are no solid things.
const LEAST_CELL_M: f64 = 1.0;
/// Smallest cell in m where there are.
const LEAST_SOLID_CELL_M: f64 = 0.25;
/// Smallest cell where there are, in heights of the lowest one that shelters.
const CELL_HEIGHTS: f64 = 0.25;
/// Height in m of the lowest solid thing that shelters.
const LEAST_SOLID_M: f64 = 0.2;
/// The same in layers of the table.
const LEAST_SOLID_LAYERS: f64 = 0.25;
/// Gap below a solid thing, in its heights, up to which it stands on the ground.
const STANDING_GAP: f64 = 0.1;
/// Width in heights of the narrowest solid thing with the wake of a bluff body.
const LEAST_BLUFF: f64 = 0.5;
/// Most cells along an edge.
const MOST_CELLS: f64 = 192.0;
/// Top of the table relative to the height of the tallest tree.
const TOP_HEIGHTS: f64 = 2.0;
/// Slope of the line below which hills shelter: the tangent of 15°.
const LEE_SLOPE: f64 = 0.267_949_192_431_122_7;
/// Share of the mean wind that is missing deep below that line: an assumption.
const LEE_LACK: f64 = 0.7;
/// Depth in m below the line at which all of that is missing: an assumption.
const LEE_DEPTH_M: f64 = 2.0;
/// Most places upwind at which higher ground is looked for.
const MOST_LEE_STEPS: f64 = 256.0;
/// Numbers that a lack in the table may have.
const UNITS: f32 = 65_536.0;
/// Rows of nodes that a thread works on at a time.
const BAND_ROWS: usize = 16;

/// Shares of the wind that are left at the heights of a node.
pub(super) type Node = [f64; LEVELS];

/// Place and cells of the shelter table of a scene: the same for every direction of the wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShelterGrid {
    /// Least x in m.
    pub west_m: f64,
    /// Least z in m.
    pub north_m: f64,
    /// Edge of a cell in m.
    pub cell_m: f64,
    /// Cells along x and z.
    pub cells: [usize; 2],
    /// Height of a layer in m.
    pub layer_m: f64,
    /// Share of the mean wind that a unit of the table lacks.
    pub lack_unit: f32,
}

/// The wind that the table is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShelterWind {
    /// Unit vector that the mean wind blows towards, along x.
    pub direction_x: f64,
    /// The same along z.
    pub direction_z: f64,
    /// Share of the leaves that hang on the trees.
    pub leaves_left: f64,
    /// Roughness length in m of the ground.
    pub roughness_m: f64,
}

impl ShelterWind {
    /// Distance along and across the wind in m.
    pub(super) fn frame(&self, x_m: f64, z_m: f64) -> [f64; 2] {
        [x_m * self.direction_x + z_m * self.direction_z, z_m * self.direction_x - x_m * self.direction_z]
    }

    /// Place of a distance along and across the wind: the inverse.
    fn place(&self, along_m: f64, across_m: f64) -> [f64; 2] {
        [
            along_m * self.direction_x - across_m * self.direction_z,
            along_m * self.direction_z + across_m * self.direction_x,
        ]
    }
}

/// Wakes of solid things.
#[derive(Clone, Debug, Default)]
struct SolidWakes {
    bluff: Vec<BluffWake>,
    others: Vec<PorousWake>,
}

impl SolidWakes {
    /// The wakes of those that stand still and are high enough for the table.
    fn of(
        solids: &[Solid],
        grid: &ShelterGrid,
        wind: &ShelterWind,
        ground_m: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let mut wakes = Self::default();
        for outline in sheltering(solids) {
            let middle_m = outline.middle_m();
            let ground_m = ground_m(middle_m.x, middle_m.z);
            let [low_m, high_m] = outline.heights_m.map(|at_m| at_m - ground_m);
            if high_m < LEAST_SOLID_M.max(LEAST_SOLID_LAYERS * grid.layer_m) {
                continue;
            }
            let footprint = Footprint::of(&outline, wind);
            let stands = low_m <= STANDING_GAP * outline.height_m();
            if stands && footprint.width_m() >= LEAST_BLUFF * high_m {
                wakes.bluff.push(BluffWake::of(footprint, high_m, outline.open, grid, wind));
            } else {
                let heights_m = [low_m.max(0.0), high_m];
                wakes.others.push(PorousWake::of_solid(&footprint, heights_m, outline.open, grid));
            }
        }
        wakes
    }
}

/// Share of the wind that two wakes leave: where either turns it back it blows back.
fn both_left(first: f64, second: f64) -> f64 {
    libm::copysign(first * second, first.min(second))
}

/// Outlines of solid things that may shelter.
fn sheltering(solids: &[Solid]) -> impl Iterator<Item = Outline> {
    let outlines = solids.iter().filter_map(Outline::of_still);
    outlines.filter(|outline| outline.height_m() >= LEAST_SOLID_M)
}

impl ShelterGrid {
    /// The grid of a scene: around its trees and solid things and the wakes that they may have, and around the hills' square. `None` if the
    /// scene has none of them.
    pub fn of(scene: &Scene, solids: &[Solid], forest: &Forest) -> Option<Self> {
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut include = |x_m: f64, z_m: f64, reach_m: f64| {
            for (axis, at_m) in [x_m, z_m].into_iter().enumerate() {
                least[axis] = least[axis].min(at_m - reach_m);
                most[axis] = most[axis].max(at_m + reach_m);
            }
        };
        let mut top_m = 0.0f64;
        for tree in forest.trees() {
            let tall_m = f64::from(tree.skeleton.height_m());
            let ends = tree.skeleton.segments.iter().map(|segment| segment.end_m.as_dvec3());
            let rim_m = ends.map(|end| libm::hypot(end.x, end.z)).fold(0.0, f64::max);
            let reach_m = rim_m + (WAKE_HEIGHTS + SWAY_HEIGHTS) * tall_m;
            include(tree.foot_m.x.into(), tree.foot_m.z.into(), reach_m + LEAST_CELL_M);
            top_m = top_m.max(TOP_HEIGHTS * tall_m);
        }
        if let Some(terrain) = scene.ground.terrain {
            include(0.0, 0.0, 0.5 * f64::from(terrain.edge_m));
            top_m = top_m.max(terrain.relief_m.into());
        }
        let mut least_cell_m = LEAST_CELL_M;
        let mut most_lack = 1.0;
        for outline in sheltering(solids) {
            // Before solid things the wind turns back.
            most_lack = 1.0 + MOST_REVERSED;
            // One that stands on the ground may reach up higher by its gap.
            let tall_m = (1.0 + STANDING_GAP) * outline.height_m();
            let middle_m = outline.middle_m();
            let rims = outline.points.iter().map(|at| libm::hypot(at.x - middle_m.x, at.z - middle_m.z));
            let rim_m = rims.fold(0.0, f64::max);
            let wide_m = 2.0 * rim_m;
            let bluff_m = tall_m * wake_heights(wide_m / outline.height_m());
            let slender_m = SLENDER_LENGTHS * libm::sqrt(wide_m * tall_m);
            let reach_m = if wide_m < LEAST_BLUFF * tall_m { slender_m } else { bluff_m };
            include(middle_m.x, middle_m.z, rim_m + reach_m + LEAST_CELL_M);
            top_m = top_m.max(TOP_HEIGHTS * tall_m);
            least_cell_m = least_cell_m.min(CELL_HEIGHTS * tall_m);
        }
        if top_m <= 0.0 {
            return None;
        }
        let edges = [most[0] - least[0], most[1] - least[1]];
        let cell_m = (edges[0].max(edges[1]) / MOST_CELLS).max(least_cell_m.max(LEAST_SOLID_CELL_M));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to MOST_CELLS")]
        let cells = edges.map(|edge_m| (libm::ceil(edge_m / cell_m).clamp(1.0, MOST_CELLS)) as usize);
        let layer_m = top_m / f64::from(SHELTER_LAYERS);
        Some(Self {
            west_m: least[0],
            north_m: least[1],
            cell_m,
            cells,
            layer_m,
            lack_unit: most_lack / UNITS,
        })
    }

    /// Number of rows of the table.
    pub fn row_count(&self) -> usize {
        (LEVELS - 1) * self.cells[0] * self.cells[1]
    }

    /// The grid as kernels read it, switched off, with the table from that row on.
    pub fn block(&self, first_row: u32) -> ShelterBlock {
        ShelterBlock {
            lack_unit: 0.0,
            first_row,
            west_m: single(self.west_m),
            north_m: single(self.north_m),
            cells_per_m: single(1.0 / self.cell_m),
            layers_per_m: single(1.0 / self.layer_m),
            cells_x: single(self.cells[0] as f64),
            cells_z: single(self.cells[1] as f64),
        }
    }

    /// The table for a wind over ground of these heights: for every cell of every layer the lack of wind at its corners, along x and then along
    /// z, below and above.
    pub fn rows(
        &self,
        scene: &Scene,
        solids: &[Solid],
        forest: &Forest,
        wind: &ShelterWind,
        ground_height_m: impl Fn(f64, f64) -> f64 + Sync,
    ) -> Vec<Uint4> {
        let nodes = self.cells.map(|cells| cells + 1);
        let wakes: Vec<_> =
            forest.trees().iter().filter_map(|tree| PorousWake::of(tree, forest, self, wind)).collect();
        let solids = SolidWakes::of(solids, self, wind, &ground_height_m);
        let layer_m = self.layer_m;
        let bands = (0..nodes[1]).step_by(BAND_ROWS).map(|first| first..(first + BAND_ROWS).min(nodes[1]));
        let left = each(bands, |band| {
            let mut left = vec![[1.0; LEVELS]; nodes[0] * band.len()];
            for wake in wakes.iter().chain(&solids.others) {
                self.add_wake(&mut left, &band, wake.reach_m(), wind, |place| wake.lack(place, layer_m));
            }
            for wake in &solids.bluff {
                self.add_wake(&mut left, &band, wake.reach_m(), wind, |place| wake.lack(place, layer_m));
            }
            if let Some(terrain) = scene.ground.terrain {
                self.add_lee(&mut left, &band, terrain.relief_m.into(), wind, &ground_height_m);
            }
            left
        });
        let left = left.concat();
        // The wind is free at the edges and at the top, and so it is beyond them.
        let lack = |x: usize, z: usize, level: usize| {
            let is_edge = x == 0 || z == 0 || x == self.cells[0] || z == self.cells[1] || level + 1 == LEVELS;
            let lack = if is_edge { 0.0 } else { 1.0 - left[z * nodes[0] + x][level] };
            word(lack / f64::from(self.lack_unit)).min(0xffff)
        };
        let mut rows = Vec::with_capacity(self.row_count());
        for layer in 0..LEVELS - 1 {
            let corner = |x, z| lack(x, z, layer) | lack(x, z, layer + 1) << 16;
            for z in 0..self.cells[1] {
                rows.extend((0..self.cells[0]).map(|x| {
                    Uint4([corner(x, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)])
                }));
            }
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
        let wakes = SolidWakes::of(solids, self, wind, &ground_height_m).bluff;
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

    /// Place of a node in m.
    fn node_m(&self, x: usize, z: usize) -> [f64; 2] {
        [self.west_m + x as f64 * self.cell_m, self.north_m + z as f64 * self.cell_m]
    }

    /// Takes what a wake lacks in a rectangle, ranges along and across the wind, from what is left of the wind in a band of rows.
    fn add_wake(
        &self,
        left: &mut [Node],
        band: &Range<usize>,
        [along, across]: [[f64; 2]; 2],
        wind: &ShelterWind,
        lack: impl Fn([f64; 2]) -> Option<Node>,
    ) {
        let corners =
            along.into_iter().flat_map(|along_m| across.map(|across_m| wind.place(along_m, across_m)));
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in corners {
            for axis in 0..2 {
                least[axis] = least[axis].min(corner[axis]);
                most[axis] = most[axis].max(corner[axis]);
            }
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
        let nodes = |axis: usize, first_m: f64| {
            let node =
                |at_m: f64| ((at_m - first_m) / self.cell_m).clamp(0.0, self.cells[axis] as f64) as usize;
            node(least[axis])..node(most[axis]) + 1
        };
        let rows = nodes(1, self.north_m);
        for z in rows.start.max(band.start)..rows.end.min(band.end) {
            for x in nodes(0, self.west_m) {
                let [x_m, z_m] = self.node_m(x, z);
                if let Some(lack) = lack(wind.frame(x_m, z_m)) {
                    let left = &mut left[(z - band.start) * (self.cells[0] + 1) + x];
                    left.iter_mut().zip(lack).for_each(|(left, lack)| *left = both_left(*left, 1.0 - lack));
                }
            }
        }
    }

    /// Takes the share of hills from what is left of the wind in their lee, in a band of rows.
    fn add_lee(
        &self,
        left: &mut [Node],
        band: &Range<usize>,
        relief_m: f64,
        wind: &ShelterWind,
        ground_height_m: impl Fn(f64, f64) -> f64,
    ) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_LEE_STEPS")]
        let steps = libm::ceil(relief_m / LEE_SLOPE / self.cell_m).min(MOST_LEE_STEPS) as usize;
        let places = band.clone().flat_map(|z| (0..=self.cells[0]).map(move |x| (x, z)));
        for ((x, z), node) in places.zip(left) {
            let [x_m, z_m] = self.node_m(x, z);
            let line_m = (1..=steps).fold(f64::NEG_INFINITY, |line_m, step| {
                let away_m = step as f64 * self.cell_m;
                let upwind =
                    ground_height_m(x_m - away_m * wind.direction_x, z_m - away_m * wind.direction_z);
                line_m.max(upwind - away_m * LEE_SLOPE)
            });
            let depth_m = line_m - ground_height_m(x_m, z_m);
            for (level, left) in node.iter_mut().enumerate() {
                let below = (depth_m - level as f64 * self.layer_m) / LEE_DEPTH_M;
                *left *= 1.0 - LEE_LACK * below.clamp(0.0, 1.0);
            }
        }
    }
}
