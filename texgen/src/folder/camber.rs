// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Camber of a dried leaf.

use glam::{DMat4, DVec3, DVec4};

use super::{FormLevel, LeafForm};
use crate::math::single;

impl LeafForm {
    /// Hollow of the upper side of the driest shape, -1 to 1 in radii of the disc with the flat blade's area: how far
    /// above a flat leaf of the same weight the pressure of the air on it seems to act. 0 without any shape.
    ///
    /// # Source
    /// A blade of curvature k moving sideways meets the air at a steeper angle on the side ahead. The torque is that of
    /// a flat blade whose middle lies higher by k/2 times the mean square of the distance from it, a quarter of kR² for
    /// a disc. k is that of the paraboloid that fits best.
    pub fn curl(&self) -> f32 {
        self.levels.last().and_then(FormLevel::curl).unwrap_or(0.0)
    }
}

impl FormLevel {
    fn curl(&self) -> Option<f32> {
        let offsets = &self.shapes.last()?.offsets;
        let corner = |at: u32| {
            let [x, y] = *self.positions.get(at as usize)?;
            let [dx, dy, dz] = *offsets.get(at as usize)?;
            Some((DVec3::new(x.into(), y.into(), 0.0), DVec3::new(dx.into(), dy.into(), dz.into())))
        };
        // Middle and area of every triangle as it lies now, and the flat blade's area.
        let mut parts = Vec::with_capacity(self.triangles.len());
        let mut flat = 0.0;
        for &[a, b, c] in &self.triangles {
            let ((a, da), (b, db), (c, dc)) = (corner(a)?, corner(b)?, corner(c)?);
            flat += 0.5 * (b - a).cross(c - a).length();
            let [a, b, c] = [a + da, b + db, c + dc];
            parts.push(((a + b + c) / 3.0, 0.5 * (b - a).cross(c - a).length()));
        }
        let area: f64 = parts.iter().map(|(_, area)| area).sum();
        let middle = parts.iter().map(|(place, area)| *place * *area).sum::<DVec3>() / area;
        // Least squares for height = a + b x + c y + k r²/2, lengths in radii.
        let radius = (flat / std::f64::consts::PI).sqrt();
        let (mut normal, mut right, mut square) = (DMat4::ZERO, DVec4::ZERO, 0.0);
        for (place, area) in &parts {
            let at = (*place - middle) / radius;
            let basis = DVec4::new(1.0, at.x, at.y, (at.x * at.x + at.y * at.y) / 2.0);
            normal +=
                DMat4::from_cols(basis * basis.x, basis * basis.y, basis * basis.z, basis * basis.w) * *area;
            right += basis * (at.z * *area);
            square += 2.0 * basis.w * *area;
        }
        let curl = (normal.inverse() * right).w * square / area / 2.0;
        curl.is_finite().then(|| single(curl.clamp(-1.0, 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FormShape;

    /// A disc of radius 0.3 that is bent to heights of its flat places.
    fn bent(height: impl Fn(f32, f32) -> f32) -> LeafForm {
        let (rings, spokes) = (24_u16, 48_u16);
        let at = |ring: u16, spoke: u16| {
            let radius = 0.3 * f32::from(ring) / f32::from(rings);
            let (sin, cos) = (std::f32::consts::TAU * f32::from(spoke) / f32::from(spokes)).sin_cos();
            [0.5 + radius * cos, 0.5 + radius * sin]
        };
        let positions: Vec<[f32; 2]> =
            (0..=rings).flat_map(|ring| (0..spokes).map(move |spoke| at(ring, spoke))).collect();
        let index = |ring: u16, spoke: u16| u32::from(ring) * u32::from(spokes) + u32::from(spoke % spokes);
        let quads = (0..rings).flat_map(|ring| (0..spokes).map(move |spoke| (ring, spoke)));
        let triangles = quads
            .flat_map(|(r, s)| {
                [
                    [index(r, s), index(r + 1, s), index(r + 1, s + 1)],
                    [index(r, s), index(r + 1, s + 1), index(r, s + 1)],
                ]
            })
            .collect();
        let offsets = positions.iter().map(|[x, y]| [0.0, 0.0, height(x - 0.5, y - 0.5)]).collect();
        let shapes = vec![FormShape { water: 0.0, offsets }];
        LeafForm { levels: vec![FormLevel { positions, triangles, shapes }] }
    }

    #[test]
    fn a_bowl_is_as_hollow_as_its_curvature_says() {
        // Curvature 0.4 per radius: a quarter of it.
        let bowl = |sign: f32| bent(move |x, y| sign * 0.2 * (x * x + y * y) / 0.3).curl();
        assert!((bowl(1.0) - 0.1).abs() < 0.003, "{}", bowl(1.0));
        assert!((bowl(-1.0) + 0.1).abs() < 0.003, "the other way: {}", bowl(-1.0));
        let gutter = bent(|x, _| 0.2 * x * x / 0.3).curl();
        assert!((gutter - 0.05).abs() < 0.003, "bent about one axis, half as much: {gutter}");
    }

    #[test]
    fn what_is_tilted_or_twisted_is_not_hollow() {
        assert!(bent(|x, y| 0.2 * x - 0.1 * y).curl().abs() < 1e-4, "tilted");
        assert!(bent(|x, y| x * y).curl().abs() < 1e-3, "twisted");
        assert_eq!(LeafForm { levels: Vec::new() }.curl().to_bits(), 0, "no shape");
    }
}
