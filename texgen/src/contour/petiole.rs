// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Petioles: how long, how thick, how bent.

use glam::Vec2;

use crate::Shape;
use crate::math::{lerp, polar, smoothstep};
use crate::rng::Rng;

/// Points from the free end up to the blade at (0, -1), with the radius at each.
///
/// # Source
/// Norway maple: 74 mm beside a width of 109 mm, means of 91 leaves (Petzoldt 2015, TU Dresden, `leaves.csv`); beech: 8 % of the
/// leaf (Niinemets and Fleck 2002); the others as floras have them.
pub(super) fn draw(shape: Shape, rng: &mut Rng) -> Vec<(Vec2, f32)> {
    let (shortest, longest, radius) = match shape {
        Shape::Maple => (1.25, 2.4, 0.022),
        Shape::JapaneseMaple => (1.05, 2.1, 0.013),
        Shape::Oak => (0.06, 0.15, 0.026),
        Shape::Birch => (0.6, 1.02, 0.016),
        Shape::Beech => (0.12, 0.28, 0.022),
        Shape::Hornbeam => (0.18, 0.34, 0.017),
        Shape::Linden => (0.75, 1.35, 0.018),
        Shape::Ginkgo => (1.2, 2.4, 0.024),
    };
    const STEPS: u16 = 24;
    let length = rng.range(shortest, longest);
    let turn_deg = rng.bell() * 70.0 * length.min(1.0);
    let mut bearing_deg = 180.0 + rng.bell() * 8.0;
    let mut at = Vec2::new(0.0, -1.0);
    let mut points = Vec::new();
    for step in 0..=STEPS {
        let t = f32::from(step) / f32::from(STEPS);
        // The free end thickens where it broke off the twig; the upper end widens into the midrib.
        let swelling = 0.5 * smoothstep(0.8, 1.0, t) + 0.25 * smoothstep(0.12, 0.0, t);
        points.push((at, radius * (lerp(1.0, 0.92, t) + swelling)));
        bearing_deg += turn_deg / f32::from(STEPS);
        at += polar(bearing_deg, length / f32::from(STEPS));
    }
    points.reverse();
    // The petiole reaches a little into the blade so that no gap can open between the two.
    points.push((Vec2::new(0.0, -0.97), radius * 0.9));
    points
}
