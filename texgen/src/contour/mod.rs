// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Outlines of leaves, one variation per seed.
//!
//! Every shape lists the knots of one half margin from the petiole to the tip; the other half is a second draw of the
//! same recipe, mirrored, so that no leaf is symmetric.

mod bend;
mod drawn;
mod fan;
mod japanese_maple;
mod oak;
mod palmate;
mod petiole;
mod toothed;
mod untangle;

pub use drawn::DrawnLeaf;

use glam::Vec2;

use crate::Shape;
use crate::rng::Rng;

/// Outline of a leaf in leaf coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Margin of the blade: a closed polygon, counter-clockwise, first point not repeated.
    pub(crate) blade: Vec<Vec2>,
    /// Points of the petiole from its free end to the blade, with the radius at each.
    pub(crate) petiole: Vec<(Vec2, f32)>,
    /// Upper end of the midrib.
    pub(crate) tip: Vec2,
}

impl Outline {
    /// Draws the outline of a leaf.
    pub(crate) fn draw(shape: Shape, rng: &Rng) -> Self {
        let mut shared = rng.fork(1);
        let (mut right, mut left) = (rng.fork(2), rng.fork(3));
        let halves = match shape {
            Shape::Maple => palmate::halves(&mut shared, &mut right, &mut left),
            Shape::JapaneseMaple => japanese_maple::halves(&mut shared, &mut right, &mut left),
            Shape::Oak => oak::halves(&mut shared, &mut right, &mut left),
            Shape::Birch => toothed::birch(&mut shared, &mut right, &mut left),
            Shape::Beech => toothed::beech(&mut shared, &mut right, &mut left),
            Shape::Hornbeam => toothed::hornbeam(&mut shared, &mut right, &mut left),
            Shape::Linden => toothed::linden(&mut shared, &mut right, &mut left),
            Shape::Ginkgo => fan::halves(&mut shared, &mut right, &mut left),
        };
        let petiole = petiole::draw(shape, &mut rng.fork(4));
        let outline = Self::join(halves, petiole);
        // The notch of a ginkgo's fan ends far below where a tip would be.
        if shape == Shape::Ginkgo { Self { tip: Vec2::Y, ..outline } } else { outline }
    }

    /// Outline of a right half margin and a left one that is drawn on the right side as well, each from the petiole's
    /// end to the tip, both included.
    fn join((right, left): (Vec<Vec2>, Vec<Vec2>), petiole: Vec<(Vec2, f32)>) -> Self {
        let tip = right[right.len() - 1];
        let mut blade = right;
        let inner = 1..left.len() - 1;
        blade.extend(left[inner].iter().rev().copied().map(mirror));
        Self { blade: untangle::untangle(blade), petiole, tip }
    }
}

/// Reflects at the midrib.
fn mirror(p: Vec2) -> Vec2 {
    Vec2::new(-p.x, p.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};

    /// Signed area of a polygon, positive when counter-clockwise.
    fn area(polygon: &[Vec2]) -> f32 {
        let next = polygon.iter().cycle().skip(1);
        polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f32>() / 2.0
    }

    /// Number of pairs of edges that cross well inside both.
    fn crossings(polygon: &[Vec2]) -> usize {
        let edge = |i: usize| (polygon[i], polygon[(i + 1) % polygon.len()]);
        let inside = |t: f32| t > 1e-3 && t < 1.0 - 1e-3;
        let pairs = (0..polygon.len()).flat_map(|i| (i + 2..polygon.len()).map(move |j| (i, j)));
        pairs
            .filter(|&(i, j)| {
                let ((a, b), (c, d)) = (edge(i), edge(j));
                let area = (b - a).perp_dot(d - c);
                inside((c - a).perp_dot(d - c) / area) && inside((c - a).perp_dot(b - a) / area)
            })
            .count()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]
        #[test]
        fn outlines_are_closed_finite_and_simple(seed in any::<u64>(), which in 0..Shape::ALL.len()) {
            let outline = Outline::draw(Shape::ALL[which], &Rng::new(seed));
            prop_assert!(outline.blade.iter().all(|p| p.is_finite()), "margin has points that are not finite");
            prop_assert!(outline.blade.iter().all(|p| p.length() < 3.2), "margin runs far away");
            prop_assert!(area(&outline.blade) > 0.6, "blade too small or clockwise: {}", area(&outline.blade));
            let longest = outline.blade.iter().zip(outline.blade.iter().cycle().skip(1))
                .map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            prop_assert!(longest < 0.45, "margin has a gap of {longest}");
            let crossed = crossings(&outline.blade);
            prop_assert!(crossed == 0, "margin crosses itself {crossed} times");
        }
    }
}
