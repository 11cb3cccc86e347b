// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade's outline: Fourier amplitudes, overlap, greatest gap, proportions.

use glam::Vec2;

use super::portrait::axis;
use crate::extract::outline::twice_area;
use crate::fill::fill;
use crate::math::{floor_i32, lerp};
use crate::outline_model::centroid;
use crate::{Blade, Mask};

/// Harmonics that are compared, from the second on.
const HARMONICS: usize = 20;
/// √A of the compared masks in pixels.
const SIDE: f32 = 100.0;
/// Side of the compared masks in √A; the blade is centred in it.
const FRAME: f32 = 4.0;
/// Points along an outline.
const POINTS: usize = 512;
/// Steps of the search for the best rotation in degrees: coarse over the circle, then fine.
const TURNS: (f32, f32) = (4.0, 0.5);

/// An outline with unit area around the origin.
#[derive(Clone, Debug)]
pub(super) struct Silhouette {
    points: Vec<Vec2>,
    mask: Mask,
    /// Some of the pixels inside, as positions.
    pixels: Vec<Vec2>,
    /// Amplitudes of harmonics 2 and up, the first being 1.
    amplitudes: Vec<f32>,
    /// Extent along the midrib by extent across.
    aspect: f32,
    /// 4π area by squared perimeter.
    circularity: f32,
}

impl Silhouette {
    /// Measures a blade.
    pub(super) fn of(blade: &Blade) -> Self {
        let side = (twice_area(&blade.outline).abs() / 2.0).sqrt().max(1e-6);
        let centre = centroid(&blade.outline);
        let polygon: Vec<Vec2> = blade.outline.iter().map(|p| (*p - centre) / side).collect();
        let points = evenly(&polygon);
        let enlarged: Vec<Vec2> = polygon.iter().map(|p| (*p + Vec2::splat(FRAME / 2.0)) * SIDE).collect();
        let pixels_wide = floor_i32(FRAME * SIDE).unsigned_abs();
        let mask = fill(&enlarged, pixels_wide, pixels_wide);
        let place = |i: usize| {
            let columns = pixels_wide as usize;
            let at = Vec2::new((i % columns) as f32 + 0.5, (i / columns) as f32 + 0.5);
            at / SIDE - Vec2::splat(FRAME / 2.0)
        };
        let pixels = (0..mask.inside.len()).filter(|i| mask.inside[*i]).map(place).collect();
        let along = axis(blade);
        let extent = |direction: Vec2| {
            let reach = || points.iter().map(|p| p.dot(direction));
            reach().fold(f32::MIN, f32::max) - reach().fold(f32::MAX, f32::min)
        };
        let perimeter: f32 =
            polygon.iter().zip(polygon.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b)).sum();
        Self {
            amplitudes: amplitudes(&points),
            aspect: extent(along) / extent(Vec2::new(-along.y, along.x)).max(1e-6),
            circularity: 4.0 * std::f32::consts::PI / (perimeter * perimeter).max(1e-6),
            points,
            mask,
            pixels,
        }
    }

    /// Euclidean distance of the Fourier amplitudes.
    pub(super) fn fourier_difference(&self, other: &Self) -> f32 {
        let pairs = self.amplitudes.iter().zip(&other.amplitudes);
        pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
    }

    /// 1 - IoU and Hausdorff distance in √A, at the rotation and mirror image of best overlap.
    pub(super) fn overlap_difference(&self, other: &Self) -> (f32, f32) {
        let miss = |turn: &Turn, every: usize| self.miss(other, turn, every);
        let mut best = (f32::INFINITY, Turn { degrees: 0.0, mirror: false });
        let mut consider = |turn: Turn, every: usize| {
            let score = miss(&turn, every);
            if score < best.0 {
                best = (score, turn);
            }
            best
        };
        let coarse = floor_i32(360.0 / TURNS.0);
        for mirror in [false, true] {
            for k in 0..coarse {
                consider(Turn { degrees: k as f32 * TURNS.0, mirror }, 7);
            }
        }
        let (_, around) = best;
        best.0 = f32::INFINITY;
        let fine = floor_i32(TURNS.0 / TURNS.1);
        for k in -fine..=fine {
            let degrees = around.degrees + k as f32 * TURNS.1;
            let score = miss(&Turn { degrees, ..around }, 1);
            if score < best.0 {
                best = (score, Turn { degrees, ..around });
            }
        }
        let moved: Vec<Vec2> = other.points.iter().map(|p| best.1.apply(*p)).collect();
        (best.0, hausdorff(&self.points, &moved).max(hausdorff(&moved, &self.points)))
    }

    /// 1 - IoU with the other outline turned, judged by every so many pixels.
    fn miss(&self, other: &Self, turn: &Turn, every: usize) -> f32 {
        let hits = other.pixels.iter().step_by(every).filter(|p| {
            let at = (turn.apply(**p) + Vec2::splat(FRAME / 2.0)) * SIDE;
            self.mask.contains(floor_i32(at.x), floor_i32(at.y))
        });
        let both = (hits.count() * every) as f32;
        let any = (self.pixels.len() + other.pixels.len()) as f32 - both;
        1.0 - both / any.max(1.0)
    }

    /// Logarithms of the ratios of aspect and circularity.
    pub(super) fn proportion_difference(&self, other: &Self) -> (f32, f32) {
        let log_ratio = |a: f32, b: f32| libm::logf(a.max(1e-6) / b.max(1e-6)).abs();
        (log_ratio(self.aspect, other.aspect), log_ratio(self.circularity, other.circularity))
    }
}

/// A rotation, after a mirror image about the y axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    degrees: f32,
    mirror: bool,
}

impl Turn {
    fn apply(&self, p: Vec2) -> Vec2 {
        let (sin, cos) = libm::sincosf(self.degrees.to_radians());
        let x = if self.mirror { -p.x } else { p.x };
        Vec2::new(x * cos - p.y * sin, x * sin + p.y * cos)
    }
}

/// Points at even steps along a closed polygon.
fn evenly(polygon: &[Vec2]) -> Vec<Vec2> {
    let sides = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    let perimeter: f32 = sides().map(|(a, b)| a.distance(*b)).sum();
    let step = (perimeter / POINTS as f32).max(1e-9);
    let mut points = Vec::with_capacity(POINTS);
    let mut passed = 0.0;
    for (a, b) in sides() {
        let length = a.distance(*b);
        while points.len() < POINTS && points.len() as f32 * step <= passed + length {
            let along = (points.len() as f32 * step - passed) / length.max(1e-9);
            points.push(Vec2::new(lerp(a.x, b.x, along), lerp(a.y, b.y, along)));
        }
        passed += length;
    }
    points
}

/// Amplitudes of the elliptic Fourier descriptors from the second harmonic on, by the first.
///
/// # Source
/// Kuhl and Giardina 1982, "Elliptic Fourier features of a closed contour"; at even steps their sums are plain
/// Fourier sums.
fn amplitudes(points: &[Vec2]) -> Vec<f32> {
    let amplitude = |n: usize| {
        let mut sums = [0.0_f32; 4];
        for (k, p) in points.iter().enumerate() {
            let turn = (n * k % points.len()) as f32 / points.len() as f32 * std::f32::consts::TAU;
            let (sin, cos) = libm::sincosf(turn);
            sums[0] += p.x * cos;
            sums[1] += p.x * sin;
            sums[2] += p.y * cos;
            sums[3] += p.y * sin;
        }
        sums.iter().map(|sum| sum * sum).sum::<f32>().sqrt()
    };
    let first = amplitude(1).max(1e-9);
    (2..=HARMONICS).map(|n| amplitude(n) / first).collect()
}

/// Greatest distance from a point of one outline to the nearest point of the other.
fn hausdorff(from: &[Vec2], to: &[Vec2]) -> f32 {
    let nearest = |p: &Vec2| to.iter().map(|q| p.distance_squared(*q)).fold(f32::INFINITY, f32::min);
    from.iter().map(nearest).fold(0.0, f32::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ellipse(turn: f32, flat: f32) -> Silhouette {
        let point = |k: usize| {
            let (sin, cos) = (k as f32 / 100.0 * std::f32::consts::TAU).sin_cos();
            // An egg, so that turning it half round is not the same.
            Vec2::from_angle(turn).rotate(Vec2::new(100.0 * cos + 10.0 * cos * cos, flat * 100.0 * sin))
        };
        let outline: Vec<Vec2> = (0..100).map(point).collect();
        let axis = Vec2::from_angle(turn) * 100.0;
        Silhouette::of(&Blade { mask: Mask::empty(1, 1), outline, root: -axis, tip: axis, confidence: 1.0 })
    }

    #[test]
    fn turning_changes_nothing() {
        let (a, b) = (ellipse(0.0, 0.6), ellipse(1.1, 0.6));
        let (miss, gap) = a.overlap_difference(&b);
        assert!(miss < 0.02 && gap < 0.02, "1 - IoU {miss}, Hausdorff {gap}");
        assert!(a.fourier_difference(&b) < 1e-3, "amplitudes do not turn");
        assert!(a.proportion_difference(&b).0 < 1e-2, "aspect is along the axis");
    }

    #[test]
    fn an_ellipse_has_the_known_numbers() {
        let (a, b) = (ellipse(0.0, 0.6), ellipse(0.0, 0.3));
        let (aspect, _) = a.proportion_difference(&b);
        assert!((aspect - 2.0_f32.ln()).abs() < 0.02, "half as wide: {aspect}");
        // Equal areas: axes a and b against a√2 and b/√2; the overlap of both is known in closed form.
        let (t, expected) =
            (2.0_f32.sqrt(), 1.0 - 4.0 / std::f32::consts::PI * (1.0 / 2.0_f32.sqrt()).atan());
        let overlap = 1.0 - expected;
        let miss = a.overlap_difference(&b).0;
        let exact = 1.0 - overlap / (2.0 - overlap);
        assert!((miss - exact).abs() < 0.03, "{miss}, expected {exact} for a stretch of {t}");
    }
}
