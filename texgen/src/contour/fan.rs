// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ginkgo: a fan with a crinkled outer edge and a notch in the middle.

use glam::Vec2;

use crate::math::{lerp, polar, smoothstep};
use crate::noise;
use crate::rng::Rng;
use crate::spline::{Knot, cut_corners, through};

/// Variation that both halves share.
struct Habit {
    /// Bearing of the outer corners in degrees.
    corner_deg: f32,
    /// Radius of the outer edge beside the notch.
    radius: f32,
    /// Depth of the notch as a share of the radius.
    notch: f32,
    /// Half the opening of the notch at the edge in degrees.
    opening_deg: f32,
}

/// Right and left half margin of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let notch = if shared.chance(0.75) { shared.range(0.2, 0.52) } else { shared.range(0.07, 0.16) };
    let habit = Habit {
        corner_deg: 63.0 + 9.0 * shared.bell(),
        radius: shared.range(1.85, 2.0),
        notch,
        opening_deg: 1.6 + 5.0 * notch * shared.range(0.6, 1.4),
    };
    (half(&habit, right), half(&habit, left))
}

/// Half margin from the petiole's end to the notch.
fn half(habit: &Habit, rng: &mut Rng) -> Vec<Vec2> {
    let base = Vec2::new(0.0, -1.0);
    let corner_deg = habit.corner_deg + 4.0 * rng.bell();
    let corner_radius = habit.radius * (0.86 + 0.06 * rng.bell());
    let seed = rng.bits();
    let flank = [
        Knot { at: base, arrive: Vec2::Y, leave: polar(22.0, 0.8) },
        Knot {
            at: base + polar(corner_deg, corner_radius),
            arrive: polar(corner_deg + 14.0, 1.0),
            leave: Vec2::Y,
        },
    ];
    let mut edge = through(&flank, 36);
    const STEPS: u16 = 72;
    for step in 1..=STEPS {
        let t = f32::from(step) / f32::from(STEPS);
        let bearing = lerp(corner_deg, habit.opening_deg, t);
        let radius = lerp(corner_radius, habit.radius, smoothstep(0.0, 0.75, t));
        // Broad waves, fine crinkles and an occasional shallow slit.
        let waves = 0.035 * noise::fractal(seed, Vec2::new(bearing * 0.11, 0.5), 2)
            + 0.016 * noise::value(seed ^ 1, Vec2::new(bearing * 0.5, 1.5));
        let slit = smoothstep(0.72, 0.95, noise::value(seed ^ 2, Vec2::new(bearing * 0.16, 2.5)));
        let calm = smoothstep(0.0, 0.1, t);
        edge.push(base + polar(bearing, radius * (1.0 + calm * (waves - 0.1 * slit))));
    }
    // Down into the notch: its walls bulge, so it narrows quickly and ends in a point.
    let depth = habit.radius * habit.notch;
    for (part, opening) in [(0.12_f32, 0.72_f32), (0.35, 0.42), (0.65, 0.2), (0.9, 0.07)] {
        edge.push(base + polar(habit.opening_deg * opening, habit.radius - depth * part));
    }
    edge.push(base + Vec2::new(0.0, habit.radius - depth));
    cut_corners(&cut_corners(&edge))
}
