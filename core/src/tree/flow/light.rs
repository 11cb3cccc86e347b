// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light in a hull that leaves fill evenly, on a grid of nodes.
//!
//! # Source
//! Light of a node through the leaves that are not there yet: G. Zachmann's lectures ("Virtuelle Realität und Simulation", 2008). The rays
//! are those of the sun and of 32 directions spread evenly over the sky, weakened as exp(-k s) on a way s through the hull (Beer and Lambert;
//! for crowns M. Monsi and T. Saeki, 1953).

use std::f64::consts::PI;

use glam::DVec3;

use super::hull::Hull;
use crate::scene::{CrownLight, Sun};
use crate::threads::each;

/// Rays to the sky.
const SKY_RAYS: u32 = 32;
/// Steps of a ray in a cell of the grid.
const STEPS_PER_CELL: f64 = 2.0;

/// Light at the nodes of a grid around a hull, as a share of that of the open sky.
#[derive(Clone, Debug)]
pub(super) struct LightGrid {
    low_m: DVec3,
    cell_m: DVec3,
    nodes: usize,
    /// Along x first and z last.
    light: Vec<f64>,
}

/// Unit vector to the sun.
pub(super) fn toward(sun: &Sun) -> DVec3 {
    let (sin, cos) = libm::sincos(f64::from(sun.azimuth_deg).to_radians());
    let (up, level) = libm::sincos(f64::from(sun.elevation_deg).to_radians());
    DVec3::new(level * cos, up, level * sin)
}

/// Directions spread evenly over the upper half of space.
fn sky() -> impl Iterator<Item = DVec3> {
    let turn = PI * (3.0 - libm::sqrt(5.0));
    (0..SKY_RAYS).map(move |ray| {
        let up = (f64::from(ray) + 0.5) / f64::from(SKY_RAYS);
        let (sin, cos) = libm::sincos(turn * f64::from(ray));
        let level = libm::sqrt(1.0 - up * up);
        DVec3::new(level * cos, up, level * sin)
    })
}

impl LightGrid {
    /// The light in a hull under a sun in that direction; `stops` says which rays meet an obstacle.
    pub(super) fn of(
        hull: &Hull,
        shade: &CrownLight,
        sun: DVec3,
        stops: &(impl Fn(DVec3, DVec3) -> bool + Sync),
    ) -> Self {
        let nodes = shade.nodes as usize;
        let (low_m, high_m) = (hull.low_m(), hull.high_m());
        let cell_m = (high_m - low_m) / f64::from(shade.nodes - 1);
        let step_m = cell_m.max_element() / STEPS_PER_CELL;
        let direct = if sun.y > 0.0 { f64::from(shade.direct) } else { 0.0 };
        let diffuse = (1.0 - f64::from(shade.direct)) / f64::from(SKY_RAYS);
        let extinction = f64::from(shade.extinction_per_m);
        let ray = |place: DVec3, direction: DVec3| {
            if stops(place, direction) {
                return 0.0;
            }
            libm::exp(-extinction * hull.way_m(place, direction, step_m))
        };
        let near = |place: DVec3| {
            // A node outside counts for the places between it and its neighbours inside.
            let around = (0..27).map(|at: u8| {
                let digits = DVec3::new(f64::from(at % 3), f64::from(at / 3 % 3), f64::from(at / 9));
                place + (digits - 1.0) * cell_m
            });
            around.into_iter().any(|place| hull.holds(place))
        };
        let node = |place: DVec3| {
            if !near(place) {
                return 0.0;
            }
            let from_sun = if direct > 0.0 { direct * ray(place, sun) } else { 0.0 };
            from_sun + diffuse * sky().map(|direction| ray(place, direction)).sum::<f64>()
        };
        let layer = |z: u32| -> Vec<f64> {
            let rows = (0..shade.nodes).flat_map(|y| (0..shade.nodes).map(move |x| (x, y)));
            rows.map(|(x, y)| node(low_m + DVec3::new(x.into(), y.into(), z.into()) * cell_m)).collect()
        };
        let light = each(0..shade.nodes, layer).concat();
        Self { low_m, cell_m, nodes, light }
    }

    /// Light at a place in the grid, linear between nodes.
    pub(super) fn at(&self, place: DVec3) -> f64 {
        let last = (self.nodes - 2) as f64;
        let cell = (place - self.low_m) / self.cell_m;
        let whole = DVec3::new(
            libm::floor(cell.x).clamp(0.0, last),
            libm::floor(cell.y).clamp(0.0, last),
            libm::floor(cell.z).clamp(0.0, last),
        );
        let share = (cell - whole).clamp(DVec3::ZERO, DVec3::ONE);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to nodes - 2")]
        let [x, y, z] = whole.to_array().map(|along| along as usize);
        let node = |dx: usize, dy: usize, dz: usize| {
            self.light[((z + dz) * self.nodes + y + dy) * self.nodes + x + dx]
        };
        let mix = |a: f64, b: f64, share: f64| a + (b - a) * share;
        let row = |dy, dz| mix(node(0, dy, dz), node(1, dy, dz), share.x);
        let sheet = |dz| mix(row(0, dz), row(1, dz), share.y);
        mix(sheet(0), sheet(1), share.z)
    }

    /// Light of the brightest node.
    pub(super) fn most(&self) -> f64 {
        self.light.iter().copied().fold(0.0, f64::max)
    }
}
