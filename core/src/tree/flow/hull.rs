// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Inside and outside of a crown's hull.
//!
//! A mesh is sampled once, in cells of a 64th of its longest edge: each is in the hull if its middle is.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::surface::Surface;
use crate::tree::grammar::Draws;

/// Cells along the longest edge of a mesh.
const CELLS: f64 = 64.0;

/// Bulges and dents of a profile.
const BULGES: u32 = 14;
/// Height of the highest by itself, as a share of the largest: they add up.
const STEEP: f64 = 1.6;

/// A closed hull in the tree's frame.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    shape: Shape,
    low_m: DVec3,
    high_m: DVec3,
}

#[derive(Clone, Debug)]
enum Shape {
    /// Heights and radii in m, rising, and bulges.
    Profile(Vec<(f64, f64)>, Bulges),
    Cells(Cells),
}

/// Bulges and dents of a profile, as seen from the middle of its height.
#[derive(Clone, Debug)]
struct Bulges {
    middle_m: f64,
    /// Largest share of the radius.
    most: f64,
    /// Direction, and height as a share of the radius, of each.
    places: Vec<(DVec3, f64)>,
}

impl Bulges {
    /// Factor of the radius at a place.
    fn factor(&self, place: DVec3) -> f64 {
        let Some(toward) = DVec3::new(place.x, place.y - self.middle_m, place.z).try_normalize() else {
            return 1.0;
        };
        let rise = |(direction, height): &(DVec3, f64)| {
            let near = toward.dot(*direction).max(0.0);
            height * near * near * near
        };
        1.0 + self.places.iter().map(rise).sum::<f64>().clamp(-self.most, self.most)
    }
}

/// Cells of a mesh, along x first and z last.
#[derive(Clone, Debug)]
struct Cells {
    edge_m: f64,
    count: [usize; 3],
    inside: Vec<bool>,
}

impl Hull {
    /// The hull of a profile that scenes may have, with bulges up to a share of its radius.
    pub(super) fn of_profile(height_m: f64, radii: &[(f32, f32)], bulges: f64, mut draw: Draws) -> Self {
        let rings: Vec<(f64, f64)> =
            radii.iter().map(|&(share, radius_m)| (f64::from(share) * height_m, radius_m.into())).collect();
        let widest_m = rings.iter().map(|ring| ring.1).fold(0.0, f64::max) * (1.0 + bulges);
        let corner = |height_m: f64, side_m: f64| DVec3::new(side_m, height_m, side_m);
        let (low_m, high_m) = (corner(rings[0].0, -widest_m), corner(rings[rings.len() - 1].0, widest_m));
        let count = if bulges > 0.0 { BULGES } else { 0 };
        let places = (0..count).map(|_| {
            let up = 2.0 * draw.unit() - 1.0;
            let (sin, cos) = libm::sincos(TAU * draw.unit());
            let level = libm::sqrt(1.0 - up * up);
            (DVec3::new(level * cos, up, level * sin), bulges * STEEP * (2.0 * draw.unit() - 1.0))
        });
        let middle_m = 0.5 * (low_m.y + high_m.y);
        let bulges = Bulges { middle_m, most: bulges, places: places.collect() };
        Self { shape: Shape::Profile(rings, bulges), low_m, high_m }
    }

    /// The hull of a closed surface.
    pub(super) fn of_surface(surface: &Surface) -> Self {
        let [low_m, high_m] = surface.extent_m();
        let size_m = high_m - low_m;
        let edge_m = size_m.max_element() / CELLS;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to CELLS")]
        let count = size_m.to_array().map(|along_m| libm::ceil(along_m / edge_m - 1e-9).max(1.0) as usize);
        let mut inside = vec![false; count[0] * count[1] * count[2]];
        for z in 0..count[2] {
            for y in 0..count[1] {
                let at = low_m + DVec3::new(0.0, y as f64 + 0.5, z as f64 + 0.5) * edge_m;
                let mut ends: Vec<f64> = surface.faces().filter_map(|face| crossing_m(face, at)).collect();
                ends.sort_by(f64::total_cmp);
                for pair in ends.chunks_exact(2) {
                    for x in 0..count[0] {
                        let middle_m = low_m.x + (x as f64 + 0.5) * edge_m;
                        inside[(z * count[1] + y) * count[0] + x] |= (pair[0]..pair[1]).contains(&middle_m);
                    }
                }
            }
        }
        Self { shape: Shape::Cells(Cells { edge_m, count, inside }), low_m, high_m }
    }

    /// The same hull at another size.
    pub(super) fn scaled(self, factor: f64) -> Self {
        let shape = match self.shape {
            Shape::Profile(rings, bulges) => Shape::Profile(
                rings.into_iter().map(|(y, r)| (y * factor, r * factor)).collect(),
                Bulges { middle_m: bulges.middle_m * factor, ..bulges },
            ),
            Shape::Cells(cells) => Shape::Cells(Cells { edge_m: cells.edge_m * factor, ..cells }),
        };
        Self { shape, low_m: self.low_m * factor, high_m: self.high_m * factor }
    }

    /// Lowest coordinates in m.
    pub(super) fn low_m(&self) -> DVec3 {
        self.low_m
    }

    /// Highest coordinates in m.
    pub(super) fn high_m(&self) -> DVec3 {
        self.high_m
    }

    /// Returns true for a place inside.
    pub(super) fn holds(&self, place: DVec3) -> bool {
        match &self.shape {
            Shape::Profile(rings, bulges) => {
                let next = rings.partition_point(|ring| ring.0 <= place.y);
                if next == 0 || next == rings.len() {
                    return false;
                }
                let (below, above) = (rings[next - 1], rings[next]);
                let share = (place.y - below.0) / (above.0 - below.0);
                let radius_m = (below.1 + (above.1 - below.1) * share) * bulges.factor(place);
                place.x * place.x + place.z * place.z < radius_m * radius_m
            }
            Shape::Cells(cells) => {
                let cell = (place - self.low_m) / cells.edge_m;
                let size = DVec3::from(cells.count.map(|count| count as f64));
                if cell.cmplt(DVec3::ZERO).any() || cell.cmpge(size).any() {
                    return false;
                }
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in the cells")]
                let [x, y, z] = cell.to_array().map(|along| along as usize);
                cells.inside[(z * cells.count[1] + y) * cells.count[0] + x]
            }
        }
    }

    /// Length in m of a ray's way through it, in steps of `step_m`.
    pub(super) fn way_m(&self, from: DVec3, direction: DVec3, step_m: f64) -> f64 {
        let longest_m = (self.high_m - self.low_m).length();
        let mut inside = 0.0;
        let mut along_m = 0.5 * step_m;
        while along_m < longest_m {
            let place = from + direction * along_m;
            // Rays rise, so they are out for good above the top.
            if place.y > self.high_m.y {
                break;
            }
            if self.holds(place) {
                inside += step_m;
            }
            along_m += step_m;
        }
        inside
    }
}

/// Place along x in m at which a line along x through `at` meets a triangle. Each of two triangles at an edge has its own side of it.
fn crossing_m([a, b, c]: [DVec3; 3], at: DVec3) -> Option<f64> {
    let side = |p: DVec3, q: DVec3| {
        // The same number for either order of the ends, but for its sign.
        let is_first = (p.y, p.z) < (q.y, q.z);
        let (p, q) = if is_first { (p, q) } else { (q, p) };
        let area = (q.y - p.y) * (at.z - p.z) - (q.z - p.z) * (at.y - p.y);
        (area >= 0.0) == is_first
    };
    let sides = [side(a, b), side(b, c), side(c, a)];
    if sides != [true; 3] && sides != [false; 3] {
        return None;
    }
    let normal = (b - a).cross(c - a);
    (normal.x != 0.0).then(|| a.x - (normal.y * (at.y - a.y) + normal.z * (at.z - a.z)) / normal.x)
}
