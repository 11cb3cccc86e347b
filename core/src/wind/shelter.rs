// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Share of the mean wind that is left behind trees, hills and solid things, on a level grid.
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

use super::bluff::{BluffWake, Footprint};
use super::porous::PorousWake;
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
/// Height in m of the lowest solid thing that shelters.
const LEAST_SOLID_M: f64 = 0.2;
/// The same in layers of the table.
const LEAST_SOLID_LAYERS: f64 = 0.25;
/// Gap below a solid thing, in its heights, up to which it stands on the ground.
pub(super) const STANDING_GAP: f64 = 0.1;
/// Width in heights of the narrowest solid thing with the wake of a bluff body.
pub(super) const LEAST_BLUFF: f64 = 0.5;
/// Slope of the line below which hills shelter: the tangent of 15°.
const LEE_SLOPE: f64 = 0.267_949_192_431_122_7;
/// Share of the mean wind that is missing deep below that line: an assumption.
const LEE_LACK: f64 = 0.7;
/// Depth in m below the line at which all of that is missing: an assumption.
const LEE_DEPTH_M: f64 = 2.0;
/// Most places upwind at which higher ground is looked for.
const MOST_LEE_STEPS: f64 = 256.0;
/// Rows of nodes that a thread works on at a time.
const BAND_ROWS: usize = 16;

/// Shares of the wind that are left at the heights of a node.
pub(super) type Node = [f64; LEVELS];

/// Place and cells of a shelter table: the same for every direction of the wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShelterGrid {
    /// Least x in m.
    pub(super) west_m: f64,
    /// Least z in m.
    pub(super) north_m: f64,
    /// Edge of a cell in m.
    pub(super) cell_m: f64,
    /// Cells along x and z.
    pub(super) cells: [usize; 2],
    /// Height of a layer in m.
    pub(super) layer_m: f64,
    /// Share of the mean wind that a unit of the table lacks.
    pub(super) lack_unit: f32,
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
pub(super) struct SolidWakes {
    pub(super) bluff: Vec<BluffWake>,
    others: Vec<PorousWake>,
}

impl SolidWakes {
    /// The wakes of those that stand still and are high enough for the table.
    pub(super) fn of(
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
pub(super) fn sheltering(solids: &[Solid]) -> impl Iterator<Item = Outline> {
    let outlines = solids.iter().filter_map(Outline::of_still);
    outlines.filter(|outline| outline.height_m() >= LEAST_SOLID_M)
}

impl ShelterGrid {
    /// Number of rows of the table.
    pub(super) fn row_count(&self) -> usize {
        (LEVELS - 1) * self.cells[0] * self.cells[1]
    }

    /// The grid as kernels read it, switched off, with the table from that row on.
    pub(super) fn block(&self, first_row: u32) -> ShelterBlock {
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

    /// Lacks of wind at the nodes over ground of these heights, those of a row along x one after another.
    pub(super) fn lacks(
        &self,
        scene: &Scene,
        solids: &[Solid],
        forest: &Forest,
        wind: &ShelterWind,
        ground_height_m: &(impl Fn(f64, f64) -> f64 + Sync),
    ) -> Vec<Node> {
        let nodes = self.cells.map(|cells| cells + 1);
        let wakes: Vec<_> =
            forest.trees().iter().filter_map(|tree| PorousWake::of(tree, forest, self, wind)).collect();
        let solids = SolidWakes::of(solids, self, wind, ground_height_m);
        let layer_m = self.layer_m;
        let bands = (0..nodes[1]).step_by(BAND_ROWS).map(|first| first..(first + BAND_ROWS).min(nodes[1]));
        let lacks = each(bands, |band| {
            let mut left = vec![[1.0; LEVELS]; nodes[0] * band.len()];
            for wake in wakes.iter().chain(&solids.others) {
                self.add_wake(&mut left, &band, wake.reach_m(), wind, |place| wake.lack(place, layer_m));
            }
            for wake in &solids.bluff {
                self.add_wake(&mut left, &band, wake.reach_m(), wind, |place| wake.lack(place, layer_m));
            }
            if let Some(terrain) = scene.ground.terrain {
                self.add_lee(&mut left, &band, terrain.relief_m.into(), wind, ground_height_m);
            }
            left.into_iter().map(|node| node.map(|left| 1.0 - left)).collect::<Vec<_>>()
        });
        lacks.concat()
    }

    /// Sets the lacks at the edges and at the top to those at places, x and z in m, so many metres above the ground.
    pub(super) fn set_rim(&self, lacks: &mut [Node], lack_at: impl Fn([f64; 2], f64) -> f64) {
        let width = self.cells[0] + 1;
        for (number, node) in lacks.iter_mut().enumerate() {
            let (x, z) = (number % width, number / width);
            let is_edge = x == 0 || z == 0 || x == self.cells[0] || z == self.cells[1];
            let first = if is_edge { 0 } else { LEVELS - 1 };
            for (level, lack) in node.iter_mut().enumerate().skip(first) {
                *lack = lack_at(self.node_m(x, z), level as f64 * self.layer_m);
            }
        }
    }

    /// Lack at a place, x and z in m, so many metres above the ground: as in [`wind_shelter`](crate::device::wind::shelter::wind_shelter).
    pub(super) fn lack_at(&self, lacks: &[Node], [x_m, z_m]: [f64; 2], above_m: f64) -> f64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
        let split = |at: f64, cells: usize| {
            let at = at.clamp(0.0, cells as f64);
            let cell = (at as usize).min(cells - 1);
            (cell, at - cell as f64)
        };
        let (x, x_share) = split((x_m - self.west_m) / self.cell_m, self.cells[0]);
        let (z, z_share) = split((z_m - self.north_m) / self.cell_m, self.cells[1]);
        let (level, up) = split(above_m / self.layer_m, LEVELS - 1);
        let between = |from: f64, to: f64, share: f64| from + share * (to - from);
        let along = |z: usize, level: usize| {
            let row = &lacks[z * (self.cells[0] + 1)..];
            between(row[x][level], row[x + 1][level], x_share)
        };
        let at = |level: usize| between(along(z, level), along(z + 1, level), z_share);
        between(at(level), at(level + 1), up)
    }

    /// The rows of a table of lacks.
    pub(super) fn rows(&self, lacks: &[Node]) -> Vec<Uint4> {
        let width = self.cells[0] + 1;
        let units = |x: usize, z: usize, level: usize| {
            word(lacks[z * width + x][level] / f64::from(self.lack_unit)).min(0xffff)
        };
        let mut rows = Vec::with_capacity(self.row_count());
        for layer in 0..LEVELS - 1 {
            let corner = |x, z| units(x, z, layer) | units(x, z, layer + 1) << 16;
            for z in 0..self.cells[1] {
                rows.extend((0..self.cells[0]).map(|x| {
                    Uint4([corner(x, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)])
                }));
            }
        }
        rows
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
