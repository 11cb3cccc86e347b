// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points listed by the cells of space that they lie in, to find near ones.

use std::collections::HashMap;

use glam::DVec3;

/// Points by cells.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    edge_m: f64,
    lists: HashMap<[i64; 3], Vec<(u32, DVec3)>>,
}

impl Cells {
    /// No points yet. Most questions should be for a reach of about an edge.
    pub(super) fn new(edge_m: f64) -> Self {
        Self { edge_m, lists: HashMap::new() }
    }

    fn cell(&self, place: DVec3) -> [i64; 3] {
        #[expect(clippy::cast_possible_truncation, reason = "trees are of some metres")]
        place.to_array().map(|along_m| libm::floor(along_m / self.edge_m) as i64)
    }

    /// Adds a point with its number.
    pub(super) fn put(&mut self, number: u32, place: DVec3) {
        let cell = self.cell(place);
        self.lists.entry(cell).or_default().push((number, place));
    }

    /// Number, place and distance in m of the nearest point that `counts`, no farther than `reach_m`. Of equally near ones the lowest number.
    pub(super) fn nearest(
        &self,
        place: DVec3,
        reach_m: f64,
        counts: impl Fn(u32) -> bool,
    ) -> Option<(u32, DVec3, f64)> {
        let mut best: Option<(u32, DVec3, f64)> = None;
        let center = self.cell(place);
        #[expect(clippy::cast_possible_truncation, reason = "a few cells")]
        let rings = libm::ceil(reach_m / self.edge_m) as i64;
        for ring in 0..=rings {
            // What is farther out is farther away than this.
            let beyond_m = (ring - 1).max(0) as f64 * self.edge_m;
            if best.is_some_and(|(_, _, away_m2)| away_m2 < beyond_m * beyond_m) {
                break;
            }
            for (number, at) in self.shell(center, ring) {
                let away_m2 = at.distance_squared(place);
                let is_nearer = best.is_none_or(|(other, _, least_m2)| {
                    away_m2 < least_m2 || (away_m2 == least_m2 && number < other)
                });
                if away_m2 <= reach_m * reach_m && is_nearer && counts(number) {
                    best = Some((number, at, away_m2));
                }
            }
        }
        best.map(|(number, at, away_m2)| (number, at, libm::sqrt(away_m2)))
    }

    /// Points of the cells that are so many cells from one.
    fn shell(&self, center: [i64; 3], ring: i64) -> impl Iterator<Item = (u32, DVec3)> + '_ {
        let span = -ring..=ring;
        let cells = span.clone().flat_map(move |z| {
            let is_face = z.abs() == ring;
            (-ring..=ring).flat_map(move |y| {
                let is_whole = is_face || y.abs() == ring;
                let step = if is_whole || ring == 0 { 1 } else { 2 * ring };
                (-ring..=ring).step_by(usize::try_from(step).unwrap_or(1)).map(move |x| [x, y, z])
            })
        });
        cells
            .filter_map(move |[x, y, z]| self.lists.get(&[center[0] + x, center[1] + y, center[2] + z]))
            .flatten()
            .copied()
    }
}
