// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Target auxins: points of the margin that draw veins, lobes and teeth first.

use glam::Vec2;

use super::ground::Ground;
use crate::math::path_length;
use crate::spline::resample;

/// Samples around the margin.
const SAMPLES: u16 = 720;

/// A margin in evenly spaced points.
pub(crate) struct Margin {
    /// Points, each moved inside the blade where that needs a short way only.
    points: Vec<Option<Vec2>>,
    /// Points as the outline has them.
    outline: Vec<Vec2>,
    /// +1 when a left turn of the sampled outline is a bulge outward, -1 otherwise.
    turn: f32,
    /// Distance between neighbouring points in pixels.
    spacing: f32,
}

impl Margin {
    /// Samples an outline of at least three points.
    pub(crate) fn new(outline: &[Vec2], ground: &Ground) -> Self {
        let mut closed = outline.to_vec();
        closed.push(outline[0]);
        let spacing = path_length(&closed) / f32::from(SAMPLES);
        let mut even = resample(&closed, SAMPLES);
        even.truncate(usize::from(SAMPLES));
        let area: f32 = even.iter().zip(even.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b)).sum();
        let turn = if area < 0.0 { -1.0 } else { 1.0 };
        let inset = 0.005 * ground.unit;
        let points = (0..even.len())
            .map(|i| {
                let inward = inward(&even, i, turn);
                let inside = ground.pull_in(even[i], even[i] + inward, 0.2 * ground.unit)?;
                let deeper = inside + inward * inset;
                Some(if ground.sees(inside, deeper) { deeper } else { inside })
            })
            .collect();
        Self { points, outline: even, turn, spacing }
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.outline.len()
    }

    /// A point as a target inside the blade.
    pub(crate) fn target(&self, index: usize) -> Option<Vec2> {
        self.points[index % self.points.len()]
    }

    /// Points within a length of margin, at least two.
    pub(crate) fn window(&self, length: f32) -> usize {
        let wanted = (length / self.spacing.max(1e-6)).round().max(2.0);
        crate::math::floor_i32(wanted).try_into().unwrap_or(2).min(self.len() / 4)
    }

    /// Distance of each point from the chord between those a window before and after it, negative in a sinus.
    fn prominence(&self, window: usize) -> Vec<f32> {
        let count = self.len();
        (0..count)
            .map(|i| {
                let before = self.outline[(i + count - window) % count];
                let after = self.outline[(i + window) % count];
                let chord = (after - before).normalize_or_zero();
                (before - self.outline[i]).perp_dot(chord) * -self.turn
            })
            .collect()
    }

    /// Indices of the points that stand out most within a window, at least `least` pixels.
    pub(crate) fn tips(&self, length: f32, least: f32) -> Vec<(usize, f32)> {
        let window = self.window(length);
        let prominence = self.prominence(window);
        let count = self.len();
        let is_peak = |i: usize| {
            let near = (1..=window).flat_map(|k| [(i + k) % count, (i + count - k) % count]);
            near.into_iter()
                .all(|j| prominence[j] < prominence[i] || (prominence[j] == prominence[i] && i < j))
        };
        (0..count).filter(|&i| prominence[i] >= least && is_peak(i)).map(|i| (i, prominence[i])).collect()
    }

    /// Index of the point nearest to a place.
    pub(crate) fn nearest(&self, p: Vec2) -> usize {
        let far = |i: &usize| self.outline[*i].distance_squared(p);
        (0..self.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
    }

    /// Steps along the margin from one index to another, the shorter way.
    pub(crate) fn apart(&self, a: usize, b: usize) -> usize {
        let ahead = a.abs_diff(b);
        ahead.min(self.len() - ahead)
    }
}

/// Unit direction into the blade: along the axis of a pointed tip, square to the margin elsewhere.
fn inward(outline: &[Vec2], index: usize, turn: f32) -> Vec2 {
    const WINDOW: usize = 8;
    let count = outline.len();
    let before = outline[(index + count - WINDOW) % count];
    let after = outline[(index + WINDOW) % count];
    let normal = (after - before).normalize_or_zero().perp() * turn;
    let to_chord = before.lerp(after, 0.5) - outline[index];
    let pointed = to_chord.dot(normal) > 0.3 * before.distance(after);
    (if pointed { to_chord.normalize_or_zero() } else { normal }).normalize_or(normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;

    #[test]
    fn lobes_are_tips_and_sinuses_are_not() {
        let blade = Shape::JapaneseMaple.draw(400, 3).expect("the size is allowed").blade;
        let ground = Ground::survey(&blade).expect("a leaf has room");
        let margin = Margin::new(&blade.outline, &ground);
        let tips = margin.tips(0.13 * ground.unit, 0.02 * ground.unit);
        let far = |index: usize| margin.outline[index].distance(ground.root) / ground.unit;
        let mut highest = tips.clone();
        highest.sort_by(|a, b| b.1.total_cmp(&a.1));
        assert!(highest.len() >= 5, "{} tips", highest.len());
        assert!(
            highest[..5].iter().all(|(index, _)| far(*index) > 0.5),
            "sinuses lie near the root, lobes do not"
        );
        let reversed: Vec<Vec2> = blade.outline.iter().rev().copied().collect();
        let again = Margin::new(&reversed, &ground).tips(0.13 * ground.unit, 0.02 * ground.unit);
        assert!(again.len().abs_diff(tips.len()) <= 2, "the sense of the outline does not matter");
    }
}
