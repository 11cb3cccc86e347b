// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Caps of snow on things that stand still: a grid over each along its own sides, finer towards its rims, from which snow rounds off.

use std::ops::Range;

use glam::{DVec2, DVec3};
use windfall_core::blocks::NEVER;
use windfall_core::device::terrain::snow::snow_cell;
use windfall_core::solid::{Footprint, Solid};
use windfall_core::{CompiledScene, shared_struct};

use super::snow_cells::bearers;

/// Distances in metres from a rim of the outermost grid lines.
const RIM_M: [f64; 8] = [0.0005, 0.006, 0.014, 0.026, 0.042, 0.064, 0.094, 0.13];
/// Distance of the others, and most of them to a side.
const MIDDLE_M: f64 = 0.1;
const MOST_LINES: f64 = 256.0;
/// Slope from which on a side is a rim.
const RIM_SLOPE: f64 = 1.5;
/// Upward parts of a normal from which on snow begins to lie, and lies in full: set by eye.
const BEARS_FROM: [f64; 2] = [0.5, 0.85];

shared_struct! {
    /// A corner of the grid of a cap.
    pub(crate) struct CapNode, padding 12 {
        /// Place on the thing in metres.
        place_m: [f32; 3],
        /// Distance from the nearest rim in metres.
        rim_m: f32,
        /// Number of the corner before it along the first side; its own where there is none.
        before: u32,
        /// Number of the corner after it along the first side, likewise.
        after: u32,
        /// Number of the corner before it along the second side, likewise.
        near: u32,
        /// Number of the corner after it along the second side, likewise.
        far: u32,
        /// Share of the snow that lies there, as steep as it is.
        bears: f32,
    }
}

/// Caps of all things.
#[derive(Debug, Default)]
pub(crate) struct SnowCaps {
    /// Corners.
    pub(crate) nodes: Vec<CapNode>,
    /// Triangles, by numbers of corners.
    pub(crate) indices: Vec<u32>,
}

/// Places of the grid lines across a side, from its middle.
fn lines_m(half_m: f64) -> Vec<f64> {
    let rim: Vec<f64> =
        RIM_M.into_iter().map(|rim_m| half_m - rim_m).filter(|line_m| *line_m > 0.0).collect();
    let Some(&inner_m) = rim.last() else { return Vec::new() };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let count = (2.0 * inner_m / MIDDLE_M).ceil().clamp(1.0, MOST_LINES) as u32;
    let middle = (1..count).map(|line| inner_m * (2.0 * f64::from(line) / f64::from(count) - 1.0));
    rim.iter().map(|line_m| -line_m).chain(middle).chain(rim.iter().rev().copied()).collect()
}

/// Corners of a grid over a thing.
struct Grid {
    width: usize,
    /// Offsets from the middle, along and across.
    offsets_m: Vec<DVec2>,
    /// Places on the thing, where it is below.
    tops_m: Vec<Option<DVec3>>,
}

impl Grid {
    fn over(solid: &Solid, footprint: &Footprint) -> Self {
        let [along, across] = footprint.half_m.to_array().map(lines_m);
        let offsets_m: Vec<_> =
            across.iter().flat_map(|&y| along.iter().map(move |&x| DVec2::new(x, y))).collect();
        let top = |offset_m: &DVec2| {
            let at = footprint.place_m(*offset_m);
            solid.top_m(at.x, at.y).map(|top_m| DVec3::new(at.x, top_m, at.y))
        };
        Self { width: along.len(), tops_m: offsets_m.iter().map(top).collect(), offsets_m }
    }

    /// The corner so far along and across from another, if the thing is below it.
    fn beside(&self, node: usize, along: isize, across: isize) -> Option<usize> {
        let (column, line) = ((node % self.width).checked_add_signed(along)?, node / self.width);
        let number = line.checked_add_signed(across)? * self.width + column;
        (column < self.width && self.tops_m.get(number)?.is_some()).then_some(number)
    }

    /// Distance between two corners as seen from above.
    fn apart_m(&self, a: usize, b: usize) -> f64 {
        self.offsets_m[a].distance(self.offsets_m[b])
    }

    /// Fall from one corner to another over the way between them.
    fn fall(&self, from: usize, to: usize) -> f64 {
        let height = |node: usize| self.tops_m[node].map_or(0.0, |top_m| top_m.y);
        (height(from) - height(to)) / self.apart_m(from, to).max(1e-9)
    }

    /// Distances of all corners from the nearest rim: where the thing ends, or falls steeply.
    fn rims_m(&self) -> Vec<f64> {
        const SIDES: [(isize, isize); 4] = [(-1, 0), (1, 0), (0, -1), (0, 1)];
        const AROUND: [(isize, isize); 8] =
            [(-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1)];
        let is_rim = |node: usize| {
            SIDES.iter().any(|&(along, across)| {
                self.beside(node, along, across).is_none_or(|beside| self.fall(node, beside) > RIM_SLOPE)
            })
        };
        let count = self.tops_m.len();
        let mut rims_m: Vec<f64> =
            (0..count).map(|node| if is_rim(node) { 0.0 } else { f64::INFINITY }).collect();
        // Two sweeps there and back carry distances around corners.
        let order: Vec<usize> = (0..count).chain((0..count).rev()).collect();
        for &node in order.iter().chain(&order).filter(|node| self.tops_m[**node].is_some()) {
            for (along, across) in AROUND {
                if let Some(beside) = self.beside(node, along, across) {
                    rims_m[node] = rims_m[node].min(rims_m[beside] + self.apart_m(node, beside));
                }
            }
        }
        rims_m
    }

    /// Share of the snow that lies on a corner, as steep as the thing is there.
    fn bears(&self, node: usize) -> f64 {
        let slope = |(along, across): (isize, isize)| {
            let back = self.beside(node, -along, -across).unwrap_or(node);
            let on = self.beside(node, along, across).unwrap_or(node);
            if back == on { 0.0 } else { self.fall(back, on) }
        };
        let up = 1.0 / (1.0 + slope((1, 0)).powi(2) + slope((0, 1)).powi(2)).sqrt();
        let share = ((up - BEARS_FROM[0]) / (BEARS_FROM[1] - BEARS_FROM[0])).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }
}

impl SnowCaps {
    /// Caps of the things of a scene on which snow may lie.
    pub(crate) fn new(compiled: &CompiledScene) -> Self {
        let mut caps = Self::default();
        let snow = &compiled.block().snow;
        for (solid, footprint) in bearers(compiled) {
            let grid = Grid::over(solid, &footprint);
            let is_within = |top_m: &Option<DVec3>| {
                top_m.map(|at| at.as_vec3()).is_some_and(|at| snow_cell(snow, at.x, at.z) != NEVER)
            };
            if grid.tops_m.iter().any(is_within) {
                caps.add(&grid);
            }
        }
        caps
    }

    fn add(&mut self, grid: &Grid) {
        let first = self.nodes.len();
        let number = |node: usize| u32::try_from(first + node).unwrap_or(u32::MAX);
        let rims_m = grid.rims_m();
        for (node, &rim_m) in rims_m.iter().enumerate() {
            let of = DVec2::new(if rim_m.is_finite() { rim_m } else { 0.0 }, grid.bears(node)).as_vec2();
            let beside = |along, across| number(grid.beside(node, along, across).unwrap_or(node));
            self.nodes.push(CapNode {
                place_m: grid.tops_m[node].unwrap_or_default().as_vec3().to_array(),
                rim_m: of.x,
                before: beside(-1, 0),
                after: beside(1, 0),
                near: beside(0, -1),
                far: beside(0, 1),
                bears: of.y,
                ..bytemuck::Zeroable::zeroed()
            });
        }
        let lines: Range<usize> = 0..(grid.tops_m.len() / grid.width.max(1)).saturating_sub(1);
        for at in lines.flat_map(|line| (0..grid.width - 1).map(move |column| line * grid.width + column)) {
            let corners = [at, at + 1, at + grid.width, at + grid.width + 1];
            let is_whole = corners.iter().all(|&corner| grid.tops_m[corner].is_some());
            let edges =
                [(0, 1), (0, 2), (1, 3), (2, 3)].map(|(a, b)| grid.fall(corners[a], corners[b]).abs());
            if is_whole && edges.iter().all(|fall| *fall < 4.0) {
                let [a, b, c, d] = corners.map(number);
                self.indices.extend([a, c, d, a, d, b]);
            }
        }
    }
}
