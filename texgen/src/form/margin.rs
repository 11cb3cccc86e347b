// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Widens meshes past the margin they follow, so that the picture's alpha alone draws the rim.

use std::collections::HashMap;

use glam::Vec2;

use crate::FormLevel;

impl FormLevel {
    /// Moves every corner of the margin outward by a share of the picture's side; its shapes move alike.
    pub(crate) fn widen(&mut self, by: f32) {
        let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
        for [a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry([*from.min(to), *from.max(to)]).or_default() += 1;
            }
        }
        let corner = |index: u32| Vec2::from(self.positions[index as usize]);
        let mut outward = vec![Vec2::ZERO; self.positions.len()];
        for [a, b, c] in &self.triangles {
            for (from, to, third) in [(a, b, c), (b, c, a), (c, a, b)] {
                if edges[&[*from.min(to), *from.max(to)]] == 1 {
                    let along = corner(*to) - corner(*from);
                    let across = along.perp().normalize_or_zero();
                    let out = across * -across.dot(corner(*third) - corner(*from)).signum();
                    outward[*from as usize] += out;
                    outward[*to as usize] += out;
                }
            }
        }
        for (position, out) in self.positions.iter_mut().zip(outward) {
            // Two unit normals: half their sum over its square keeps the distance to both edges, up to sharp tips.
            let shift = by * 2.0 * out / out.length_squared().max(0.8);
            let moved = Vec2::from(*position) + if out == Vec2::ZERO { Vec2::ZERO } else { shift };
            *position = moved.clamp(Vec2::ZERO, Vec2::ONE).to_array();
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::FormLevel;

    #[test]
    fn a_square_grows_on_every_side() {
        let positions = vec![[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];
        let mut level = FormLevel { positions, triangles: vec![[0, 2, 1], [1, 2, 3]], shapes: Vec::new() };
        level.widen(0.05);
        for (corner, wanted) in level.positions.iter().zip([[0.2, 0.2], [0.8, 0.2], [0.2, 0.8], [0.8, 0.8]]) {
            for (found, wanted) in corner.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-5, "{:?}", level.positions);
            }
        }
    }
}
