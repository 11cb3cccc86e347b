// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signed distances from a closed surface on a grid, between whose nodes kernels interpolate.

use glam::DVec3;

use super::nearest::Nearest;
use crate::convert::word;
use crate::surface::Surface;
use crate::threads::each;

/// Cells along the longest edge of a grid.
const CELLS: f64 = 64.0;
/// Least distance in m from a surface to the rim of its grid: leaves that reach farther meet it as a box of that distance.
const MARGIN_M: f64 = 0.1;
/// The same in cells.
const MARGIN_CELLS: f64 = 2.0;
/// Units of the distances in a cell.
pub(crate) const UNITS: f64 = 256.0;

/// Signed distances on the nodes of a grid.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DistanceGrid {
    /// Place of its first node in m.
    pub(crate) low_m: DVec3,
    /// Edge of its cells in m.
    pub(crate) cell_m: f64,
    /// Distance in m from its rim within which there is nothing of the surface.
    pub(crate) margin_m: f64,
    /// Nodes along x, y and z.
    pub(crate) nodes: [u32; 3],
    /// Distances in units of [`UNITS`] to a cell, along x first and z last.
    pub(crate) distances: Vec<i16>,
}

impl DistanceGrid {
    /// The grid of a surface.
    pub(crate) fn of(surface: &Surface) -> Self {
        let [low_m, high_m] = surface.extent_m();
        let longest_m = (high_m - low_m).max_element();
        let cell_m = ((longest_m + 2.0 * MARGIN_M) / CELLS).max(longest_m / (CELLS - 2.0 * MARGIN_CELLS));
        let margin_m = MARGIN_M.max(MARGIN_CELLS * cell_m);
        let low_m = low_m - margin_m;
        let nodes = (high_m + margin_m - low_m)
            .to_array()
            // Rounding must not add a cell to the longest edge.
            .map(|span_m| word(libm::ceil(span_m / cell_m - 1e-9)) + 1);
        let nearest = Nearest::of(surface);
        let layers = each(0..nodes[2], |z| layer(&nearest, low_m, cell_m, nodes, z));
        Self { low_m, cell_m, margin_m, nodes, distances: layers.concat() }
    }
}

/// Distances of the nodes of one layer.
fn layer(
    nearest: &Nearest<'_>,
    low_m: DVec3,
    cell_m: f64,
    [nodes_x, nodes_y, _]: [u32; 3],
    z: u32,
) -> Vec<i16> {
    let mut distances = Vec::with_capacity((nodes_x * nodes_y) as usize);
    for y in 0..nodes_y {
        let mut reach_m = f64::INFINITY;
        for x in 0..nodes_x {
            let place = low_m + cell_m * DVec3::new(x.into(), y.into(), z.into());
            let distance_m = nearest.distance_m(place, reach_m);
            // The surface is no farther from the next node than this and the way there.
            reach_m = distance_m.abs() + cell_m;
            let units = libm::round(distance_m / cell_m * UNITS);
            #[expect(clippy::cast_possible_truncation, reason = "clamped to its range")]
            distances.push(units.clamp(-32767.0, 32767.0) as i16);
        }
    }
    distances
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of a radius of 1 m by degrees: `around` of them around the equator.
    fn ball(around: u32) -> Surface {
        let rings = around / 2;
        let place = |ring: u32, step: u32| {
            let [up, along] = [(ring, rings), (step % around, around / 2)]
                .map(|(at, of)| std::f64::consts::PI * f64::from(at) / f64::from(of));
            let out = if ring.is_multiple_of(rings) { 0.0 } else { libm::sin(up) };
            DVec3::new(out * libm::sin(along), libm::cos(up), out * libm::cos(along)).as_vec3().to_array()
        };
        let mut corners = Vec::new();
        for ring in 0..rings {
            for step in 0..around {
                let [a, b] = [place(ring, step), place(ring, step + 1)];
                let [c, d] = [place(ring + 1, step), place(ring + 1, step + 1)];
                corners.extend([a, c, b, b, c, d]);
            }
        }
        let triangles: Vec<[u32; 3]> =
            (0..).step_by(3).take(corners.len() / 3).map(|at| [at, at + 1, at + 2]).collect();
        Surface::new(&corners, &triangles).expect("closed")
    }

    #[test]
    fn nodes_have_the_distances_of_a_ball() {
        let grid = DistanceGrid::of(&ball(96));
        let [nodes_x, nodes_y, nodes_z] = grid.nodes;
        assert!(grid.nodes.iter().all(|&nodes| f64::from(nodes) <= CELLS + 1.0), "{:?}", grid.nodes);
        assert_eq!(grid.distances.len(), (nodes_x * nodes_y * nodes_z) as usize, "one for each node");
        for (at, &distance) in (0..).zip(&grid.distances) {
            let node = [at % nodes_x, at / nodes_x % nodes_y, at / nodes_x / nodes_y].map(f64::from);
            let place = grid.low_m + grid.cell_m * DVec3::from(node);
            let found_m = f64::from(distance) * grid.cell_m / UNITS;
            // Its sides lie up to half a millimetre and a rounded unit within the ball.
            let off_m = found_m - (place.length() - 1.0);
            assert!((-1e-4..2e-3).contains(&off_m), "{found_m} m at {place}");
        }
    }
}
