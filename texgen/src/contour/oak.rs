// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pedunculate oak: rounded lobes along an obovate blade, small ears at the base.

use glam::Vec2;

use super::Half;
use crate::math::{lerp, polar};
use crate::rng::Rng;
use crate::spline::{Knot, through};

/// Variation that both halves share.
struct Habit {
    /// Greatest half width.
    width: f32,
    /// Depth of the sinuses as a share of the half width.
    depth: f32,
    /// Lobes on a side.
    lobes: u32,
    /// Offset of the left lobes against the right ones, in lobe spacings.
    stagger: f32,
}

/// Half width at a height `t` (0 base, 1 tip), 1 at the widest.
fn envelope(t: f32) -> f32 {
    const HEIGHTS: [f32; 9] = [0.0, 0.08, 0.2, 0.35, 0.5, 0.64, 0.78, 0.9, 1.0];
    const WIDTHS: [f32; 9] = [0.16, 0.24, 0.42, 0.7, 0.92, 1.0, 0.88, 0.62, 0.3];
    let above = HEIGHTS.iter().position(|&height| height >= t).unwrap_or(HEIGHTS.len() - 1).max(1);
    let (low, high) = (HEIGHTS[above - 1], HEIGHTS[above]);
    lerp(WIDTHS[above - 1], WIDTHS[above], ((t - low) / (high - low)).clamp(0.0, 1.0))
}

/// Both halves of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Half, Half) {
    let habit = Habit {
        width: 0.6 + 0.1 * shared.bell(),
        depth: 0.47 + 0.12 * shared.bell(),
        lobes: shared.integer(4, 5),
        stagger: shared.range(0.2, 0.5),
    };
    (half(&habit, 0.0, right), half(&habit, habit.stagger, left))
}

/// One half.
fn half(habit: &Habit, stagger: f32, rng: &mut Rng) -> Half {
    let lobes = habit.lobes as f32;
    let spacing = 0.74 / lobes;
    let height = |t: f32| 2.0 * t - 1.0;
    // The ear at the base curls back to the petiole.
    let mut knots = vec![
        Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(100.0, 0.7) },
        Knot::smooth(Vec2::new(0.1 + 0.02 * rng.bell(), height(0.035)), polar(0.0, 0.9)),
        Knot::smooth(Vec2::new(0.085, height(0.09)), polar(8.0, 0.8)),
    ];
    let mut laterals = Vec::new();
    for lobe in 0..habit.lobes {
        let t = 0.2 + spacing * (lobe as f32 + stagger * 0.55 + 0.1 * rng.bell());
        let apex_axis = lerp(66.0, 34.0, t) + 5.0 * rng.bell();
        let reach = habit.width * envelope(t) * (1.0 + 0.1 * rng.bell());
        let apex = Vec2::new(reach, height(t + 0.05 + 0.012 * rng.bell()));
        knots.push(Knot::smooth(apex, polar(apex_axis - 92.0, 1.15)));
        laterals.push(apex - polar(apex_axis, 0.03));
        let between = t + 0.5 * spacing;
        let last = lobe + 1 == habit.lobes;
        let depth = habit.depth * if last { 0.5 } else { lerp(0.75, 1.05, 1.0 - (t - 0.4).abs() * 1.6) };
        let inner = habit.width * envelope(between + 0.03) * (1.0 - depth * (1.0 + 0.16 * rng.bell()));
        let notch = Vec2::new(inner.max(0.08), height((between + 0.045).min(0.93)));
        knots.push(Knot::smooth(notch, polar(apex_axis - 82.0, 0.7)));
    }
    knots.push(Knot::smooth(Vec2::new(0.0, 1.0), polar(-90.0, 1.1)));
    Half { margin: through(&knots, 14), laterals, side_ribs: Vec::new() }
}
