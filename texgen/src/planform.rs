// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Planform of a mask: the ellipse with the same second moments.

use glam::{DMat2, DVec2};

use crate::Mask;
use crate::math::single;

impl Mask {
    /// Length over width of the ellipse with the same second moments, length being along the principal axis nearer to
    /// upright; and the geometric mean of its half axes relative to the radius of the disc with the same area, 1 for
    /// every ellipse. `None` for a mask without length or width.
    pub fn planform(&self) -> Option<(f32, f32)> {
        let width = self.width.max(1) as usize;
        let pixels = || {
            let inside = self.inside.iter().enumerate().filter(|(_, inside)| **inside);
            inside.map(|(at, _)| DVec2::new((at % width) as f64, (at / width) as f64))
        };
        let area = self.area() as f64;
        let middle = pixels().sum::<DVec2>() / area.max(1.0);
        // A pixel is a square, not a point.
        let own = DMat2::from_diagonal(DVec2::splat(area / 12.0));
        let moments = pixels().fold(own, |sum, p| {
            let off = p - middle;
            sum + DMat2::from_cols(off * off.x, off * off.y)
        });
        let moments = moments * (1.0 / area.max(1.0));
        let mean = (moments.x_axis.x + moments.y_axis.y) / 2.0;
        let half = DVec2::new((moments.y_axis.y - moments.x_axis.x) / 2.0, moments.x_axis.y).length();
        let (longer, shorter) = (2.0 * (mean + half).sqrt(), 2.0 * (mean - half).max(0.0).sqrt());
        if shorter <= 0.0 || area < 2.0 {
            return None;
        }
        let stands = moments.y_axis.y >= moments.x_axis.x;
        let aspect = if stands { longer / shorter } else { shorter / longer };
        let radius = (area / std::f64::consts::PI).sqrt();
        Some((single(aspect), single((longer * shorter).sqrt() / radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(inside: impl Fn(f32, f32) -> bool) -> Mask {
        let at = |i: usize| (((i % 200) as f32 - 99.5) / 100.0, ((i / 200) as f32 - 99.5) / 100.0);
        let pixels = (0..40_000).map(|i| inside(at(i).0, at(i).1)).collect();
        Mask { width: 200, height: 200, inside: pixels }
    }

    #[test]
    fn simple_masks_have_the_moments_of_the_books() {
        let close = |found: Option<(f32, f32)>, aspect: f32, extent: f32| {
            let (a, e) = found.expect("it has an area");
            assert!((a / aspect - 1.0).abs() < 0.01 && (e / extent - 1.0).abs() < 0.003, "{a}, {e}");
        };
        close(mask(|x, y| x * x + y * y < 0.8).planform(), 1.0, 1.0);
        close(mask(|x, y| 4.0 * x * x + y * y < 0.8).planform(), 2.0, 1.0);
        close(mask(|x, y| x * x + 9.0 * y * y < 0.8).planform(), 1.0 / 3.0, 1.0);
        close(
            mask(|x, y| x.abs() < 0.3 && y.abs() < 0.6).planform(),
            2.0,
            (std::f32::consts::PI / 3.0).sqrt(),
        );
        let turned = |x: f32, y: f32| (0.8 * x + 0.6 * y).powi(2) * 4.0 + (0.8 * y - 0.6 * x).powi(2) < 0.8;
        close(mask(turned).planform(), 2.0, 1.0);
        assert_eq!(mask(|_, _| false).planform(), None, "nothing");
    }
}
