// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Smooth curves through the points that growth leaves.

use glam::Vec2;

use crate::math::path_length;
use crate::spline::resample;

/// Kind of curve that a vein's growth points are drawn with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Curve {
    /// Uniform cubic B-spline: stays inside the hull of its points and is the smoothest.
    #[default]
    BSpline,
    /// Catmull–Rom: passes every point.
    CatmullRom,
    /// One Bézier curve of as high a degree as there are points, by de Casteljau's scheme. It flattens every bend and
    /// takes quadratic time; kept for comparison with older work.
    Bezier,
}

impl Curve {
    /// The curve in pieces about `spacing` long; both ends stay.
    pub(crate) fn draw(self, points: &[Vec2], spacing: f32) -> Vec<Vec2> {
        if points.len() < 2 {
            return points.to_vec();
        }
        let pieces = (path_length(points) / spacing).ceil().clamp(1.0, 4000.0);
        let fine = match self {
            Self::BSpline => piecewise(points, true),
            Self::CatmullRom => piecewise(points, false),
            Self::Bezier => {
                let samples = pieces.max(8.0);
                let mut at = 0.0;
                let mut out = Vec::new();
                while at <= samples {
                    out.push(de_casteljau(points, at / samples));
                    at += 1.0;
                }
                out
            }
        };
        let length = path_length(&fine);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 1..4000")]
        let count = (length / spacing).round().clamp(1.0, 4000.0) as u16;
        resample(&fine, count)
    }
}

/// Samples of a uniform cubic curve, eight to a span; the ends are tripled or mirrored so that they stay.
fn piecewise(points: &[Vec2], b_spline: bool) -> Vec<Vec2> {
    const SAMPLES: u8 = 8;
    let last = points.len() - 1;
    let mut padded = Vec::with_capacity(points.len() + 4);
    if b_spline {
        padded.extend([points[0]; 2]);
        padded.extend(points);
        padded.extend([points[last]; 2]);
    } else {
        padded.push(points[0] * 2.0 - points[1]);
        padded.extend(points);
        padded.push(points[last] * 2.0 - points[last - 1]);
    }
    let mut out = Vec::new();
    for span in padded.windows(4) {
        let [a, b, c, d] = [span[0], span[1], span[2], span[3]];
        for sample in 0..SAMPLES {
            let t = f32::from(sample) / f32::from(SAMPLES);
            let (t2, t3) = (t * t, t * t * t);
            out.push(if b_spline {
                (a * (1.0 - 3.0 * t + 3.0 * t2 - t3)
                    + b * (4.0 - 6.0 * t2 + 3.0 * t3)
                    + c * (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3)
                    + d * t3)
                    / 6.0
            } else {
                (b * 2.0
                    + (c - a) * t
                    + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2
                    + (b * 3.0 - a - c * 3.0 + d) * t3)
                    * 0.5
            });
        }
    }
    if let Some(first) = out.first_mut() {
        *first = points[0];
    }
    out.push(points[last]);
    out
}

/// Point of a Bézier curve by repeated halving of the way between its points.
fn de_casteljau(points: &[Vec2], t: f32) -> Vec2 {
    let mut row = points.to_vec();
    while row.len() > 1 {
        row = row.windows(2).map(|pair| pair[0].lerp(pair[1], t)).collect();
    }
    row[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    const ZIGZAG: [Vec2; 5] =
        [Vec2::ZERO, Vec2::new(10.0, 8.0), Vec2::new(20.0, -8.0), Vec2::new(30.0, 8.0), Vec2::new(40.0, 0.0)];

    /// Greatest distance of a curve from the straight line between its ends.
    fn swing(curve: Curve) -> f32 {
        curve.draw(&ZIGZAG, 1.0).iter().map(|p| p.y.abs()).fold(0.0, f32::max)
    }

    #[test]
    fn every_curve_keeps_its_ends() {
        for curve in [Curve::BSpline, Curve::CatmullRom, Curve::Bezier] {
            let drawn = curve.draw(&ZIGZAG, 1.0);
            assert!(drawn[0].distance(ZIGZAG[0]) < 1e-4, "{curve:?} starts at {}", drawn[0]);
            assert!(drawn[drawn.len() - 1].distance(ZIGZAG[4]) < 1e-3, "{curve:?} misses its end");
            let longest = drawn.windows(2).map(|w| w[0].distance(w[1])).fold(0.0, f32::max);
            assert!(longest < 1.6, "{curve:?} has a piece of {longest}, asked for 1");
        }
    }

    #[test]
    fn bezier_flattens_most_and_catmull_rom_least() {
        let [spline, rom, bezier] = [Curve::BSpline, Curve::CatmullRom, Curve::Bezier].map(swing);
        assert!(bezier < spline && spline < rom, "swings are {bezier}, {spline}, {rom}");
        assert!((rom - 8.0).abs() < 0.5, "Catmull–Rom passes its points, reaches {rom}");
    }
}
