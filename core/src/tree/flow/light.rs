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

/// Rays through a hull among obstacles.
struct Rays<'a, S> {
    hull: &'a Hull,
    shade: &'a CrownLight,
    sun: DVec3,
    stops: &'a S,
    cell_m: DVec3,
}

impl<S: Fn(DVec3, DVec3) -> bool> Rays<'_, S> {
    /// Share of the light of a direction that reaches a place.
    fn ray(&self, place: DVec3, direction: DVec3) -> f64 {
        if (self.stops)(place, direction) {
            return 0.0;
        }
        let step_m = self.cell_m.max_element() / STEPS_PER_CELL;
        let way_m = self.hull.way_m(place, direction, step_m);
        libm::exp(-f64::from(self.shade.extinction_per_m) * way_m)
    }

    /// Light of a node: 0 for one that no place in the hull asks for.
    fn node(&self, place: DVec3) -> f64 {
        let mut around = (0..27).map(|at: u8| {
            let digits = DVec3::new(f64::from(at % 3), f64::from(at / 3 % 3), f64::from(at / 9));
            place + (digits - 1.0) * self.cell_m
        });
        if !around.any(|place| self.hull.holds(place)) {
            return 0.0;
        }
        let direct = f64::from(self.shade.direct);
        let from_sun =
            if self.sun.y > 0.0 && direct > 0.0 { direct * self.ray(place, self.sun) } else { 0.0 };
        let from_sky: f64 = sky().map(|direction| self.ray(place, direction)).sum();
        from_sun + (1.0 - direct) / f64::from(SKY_RAYS) * from_sky
    }

    /// Light of the nodes of a layer.
    fn layer(&self, z: u32) -> Vec<f64> {
        let rows = (0..self.shade.nodes).flat_map(|y| (0..self.shade.nodes).map(move |x| (x, y)));
        let place =
            |(x, y): (u32, u32)| self.hull.low_m() + DVec3::new(x.into(), y.into(), z.into()) * self.cell_m;
        rows.map(|node| self.node(place(node))).collect()
    }
}

impl LightGrid {
    /// The light in a hull under a sun in that direction; `stops` says which rays meet an obstacle.
    pub(super) fn of(
        hull: &Hull,
        shade: &CrownLight,
        sun: DVec3,
        stops: &(impl Fn(DVec3, DVec3) -> bool + Sync),
    ) -> Self {
        let cell_m = (hull.high_m() - hull.low_m()) / f64::from(shade.nodes - 1);
        let rays = Rays { hull, shade, sun, stops, cell_m };
        let light = each(0..shade.nodes, |z| rays.layer(z)).concat();
        Self { low_m: hull.low_m(), cell_m, nodes: shade.nodes as usize, light }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::grammar::Draws;

    /// A column of 4 m on a foot of 2 m.
    fn column() -> Hull {
        let radii = [(0.33, 0.0), (0.3334, 2.0), (0.9999, 2.0), (1.0, 0.0)];
        Hull::of_profile(6.0, &radii, 0.0, Draws::new(1, 0, 0, 0))
    }

    #[test]
    fn light_falls_off_as_beer_and_lambert_have_it() {
        let shade = CrownLight { nodes: 32, extinction_per_m: 0.5, direct: 1.0, ..CrownLight::default() };
        let grid = LightGrid::of(&column(), &shade, DVec3::Y, &|_, _| false);
        for y in [2.5, 3.5, 5.0] {
            let (found, wanted) = (grid.at(DVec3::new(0.3, y, -0.4)), libm::exp(-0.5 * (6.0 - y)));
            assert!((found / wanted - 1.0).abs() < 0.06, "{found} of {wanted} at {y} m");
        }
    }

    #[test]
    fn the_open_sky_is_one_and_a_wall_hides_its_half() {
        let shade = CrownLight { extinction_per_m: 0.0, direct: 0.0, ..CrownLight::default() };
        let at = DVec3::new(0.2, 4.0, 0.1);
        let open = LightGrid::of(&column(), &shade, DVec3::Y, &|_, _| false).at(at);
        assert!((open - 1.0).abs() < 1e-12, "all rays: {open}");
        let walled = LightGrid::of(&column(), &shade, DVec3::Y, &|_, toward: DVec3| toward.x > 0.0).at(at);
        assert!((walled - 0.5).abs() < 0.05, "half the sky: {walled}");
    }

    #[test]
    fn threads_do_not_matter() {
        let (hull, shade) = (column(), CrownLight::default());
        let sun = toward(&shade.sun);
        let stops = |place: DVec3, toward: DVec3| place.x + toward.x > 0.5;
        let grid = LightGrid::of(&hull, &shade, sun, &stops);
        let rays = Rays { hull: &hull, shade: &shade, sun, stops: &stops, cell_m: grid.cell_m };
        let alone: Vec<f64> = (0..shade.nodes).flat_map(|z| rays.layer(z)).collect();
        assert_eq!(grid.light, alone, "layer by layer on this thread");
        assert!(alone.iter().any(|light| *light > 0.1), "there is light");
    }
}
