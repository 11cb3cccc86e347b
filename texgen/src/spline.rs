// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Outlines as knots: a knot fixes where the margin passes and which way it points on either side.

use glam::Vec2;

use crate::math::path_length;

/// A knot of a margin. The two directions differ at a pointed tip and agree at a rounded one; their lengths say
/// how far they pull, as a share of the chord to the neighbouring knot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    /// Position.
    pub(crate) at: Vec2,
    /// Direction of travel on arrival.
    pub(crate) arrive: Vec2,
    /// Direction of travel on departure.
    pub(crate) leave: Vec2,
}

impl Knot {
    /// Knot that the margin passes smoothly.
    pub(crate) fn smooth(at: Vec2, direction: Vec2) -> Self {
        Self { at, arrive: direction, leave: direction }
    }

    /// Pointed knot: the margin runs out along `axis` and back again.
    pub(crate) fn pointed(at: Vec2, axis: Vec2) -> Self {
        Self { at, arrive: axis, leave: -axis }
    }
}

/// Cubic Hermite curve through knots, `steps` straight pieces from each to the next.
pub(crate) fn through(knots: &[Knot], steps: u16) -> Vec<Vec2> {
    let mut points = Vec::with_capacity(knots.len() * usize::from(steps) + 1);
    for pair in knots.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let chord = a.at.distance(b.at);
        for step in 0..steps {
            let t = f32::from(step) / f32::from(steps);
            let (t2, t3) = (t * t, t * t * t);
            points.push(
                a.at * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + a.leave * chord * (t3 - 2.0 * t2 + t)
                    + b.at * (3.0 * t2 - 2.0 * t3)
                    + b.arrive * chord * (t3 - t2),
            );
        }
    }
    points.extend(knots.last().map(|knot| knot.at));
    points
}

/// The same path in `count` pieces of equal length.
pub(crate) fn resample(points: &[Vec2], count: u16) -> Vec<Vec2> {
    let step = path_length(points) / f32::from(count);
    let mut out = vec![points[0]];
    let mut left = step;
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        while from.distance(to) > left && out.len() < usize::from(count) {
            from += (to - from).normalize_or_zero() * left;
            out.push(from);
            left = step;
        }
        left -= from.distance(to);
    }
    out.extend(points.last());
    out
}

/// Cuts the corners of an open path once (Chaikin 1974); both ends stay.
pub(crate) fn cut_corners(points: &[Vec2]) -> Vec<Vec2> {
    let mut out = vec![points[0]];
    for pair in points.windows(2) {
        out.push(pair[0].lerp(pair[1], 0.25));
        out.push(pair[0].lerp(pair[1], 0.75));
    }
    out.extend(points.last());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curve_passes_its_knots() {
        let knots = [
            Knot::smooth(Vec2::ZERO, Vec2::X),
            Knot::pointed(Vec2::ONE, Vec2::Y),
            Knot::smooth(Vec2::X, -Vec2::Y),
        ];
        let points = through(&knots, 8);
        assert_eq!(points.len(), 17, "two pieces of eight steps and the end");
        assert!(points[8].distance(Vec2::ONE) < 1e-6, "the middle knot is on the curve");
    }

    #[test]
    fn resampling_spaces_evenly() {
        let points = resample(&[Vec2::ZERO, Vec2::X, Vec2::ONE], 7);
        assert_eq!(points.len(), 8, "seven pieces have eight ends");
        assert!((points[1].x - 2.0 / 7.0).abs() < 1e-5, "first piece has a seventh of the length");
    }
}
