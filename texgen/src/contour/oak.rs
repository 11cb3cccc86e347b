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
    const WIDTHS: [f32; 9] = [0.16, 0.26, 0.46, 0.72, 0.92, 1.0, 0.95, 0.74, 0.4];
    let above = HEIGHTS.iter().position(|&height| height >= t).unwrap_or(HEIGHTS.len() - 1).max(1);
    let (low, high) = (HEIGHTS[above - 1], HEIGHTS[above]);
    lerp(WIDTHS[above - 1], WIDTHS[above], ((t - low) / (high - low)).clamp(0.0, 1.0))
}

/// Both halves of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Half, Half) {
    let habit = Habit {
        width: 0.62 + 0.11 * shared.bell(),
        depth: 0.36 + 0.12 * shared.bell(),
        lobes: if shared.chance(0.7) { 4 } else { 5 },
        stagger: shared.range(0.2, 0.5),
    };
    (half(&habit, 0.0, right), half(&habit, habit.stagger, left))
}

/// A lobe as a disc that its margin goes half way around.
struct Lobe {
    centre: Vec2,
    radius: f32,
    /// Bearing in which the lobe points, in degrees.
    axis_deg: f32,
}

impl Lobe {
    /// Direction of travel around the apex.
    fn across(&self) -> Vec2 {
        polar(self.axis_deg - 90.0, 1.0)
    }

    /// Where the margin leaves the flank below (-1) or above (1) the lobe.
    fn flank(&self, side: f32) -> Vec2 {
        self.centre + self.across() * self.radius * side
    }

    /// The half circle.
    fn knots(&self) -> [Knot; 3] {
        // A Hermite quarter circle pulls with π/2 radii, 1.11 of its chord.
        let (axis, across) = (polar(self.axis_deg, 1.11), self.across() * 1.11);
        let apex = self.centre + polar(self.axis_deg, self.radius);
        [
            Knot { at: self.flank(-1.0), arrive: axis * 0.6, leave: axis },
            Knot::smooth(apex, across),
            Knot { at: self.flank(1.0), arrive: -axis, leave: axis * -0.6 },
        ]
    }
}

/// Lobes of one half from the base up, the rounded tip included.
fn lobes(habit: &Habit, stagger: f32, rng: &mut Rng) -> Vec<Lobe> {
    let spacing = 0.71 / habit.lobes as f32;
    let mut lobes = Vec::new();
    for lobe in 0..habit.lobes {
        let t = 0.25 + spacing * (lobe as f32 + stagger * 0.5 + 0.07 * rng.bell());
        let axis_deg = lerp(72.0, 26.0, t * t.sqrt()) + 3.5 * rng.bell();
        let reach = habit.width * envelope(t) * (1.0 + 0.1 * rng.bell());
        let radius = spacing * axis_deg.to_radians().sin() * rng.range(0.85, 1.05) * lerp(0.85, 1.1, t);
        let apex = Vec2::new(reach, 2.0 * t - 1.0);
        lobes.push(Lobe { centre: apex - polar(axis_deg, radius), radius, axis_deg });
    }
    let radius = habit.width * rng.range(0.34, 0.44);
    lobes.push(Lobe { centre: Vec2::new(0.0, 1.0 - radius), radius, axis_deg: 0.0 });
    for upper in 1..lobes.len() {
        part(&mut lobes, upper);
    }
    lobes
}

/// Narrows a lobe and the one below it until a sinus fits between them; their apices stay.
fn part(lobes: &mut [Lobe], upper: usize) {
    let (low, high) = (&lobes[upper - 1], &lobes[upper]);
    let across = (low.across() + high.across()).normalize_or(Vec2::Y);
    let room = (high.centre - low.centre).dot(across) * 0.84;
    let share = (room / (low.radius + high.radius)).clamp(0.5, 1.0);
    for lobe in &mut lobes[upper - 1..=upper] {
        lobe.centre += polar(lobe.axis_deg, lobe.radius * (1.0 - share));
        lobe.radius *= share;
    }
}

/// One half.
fn half(habit: &Habit, stagger: f32, rng: &mut Rng) -> Half {
    // The ear at the base curls back to the petiole.
    let mut knots = vec![
        Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(100.0, 0.7) },
        Knot::smooth(Vec2::new(0.1 + 0.02 * rng.bell(), -0.93), polar(0.0, 0.9)),
        Knot::smooth(Vec2::new(0.085, -0.82), polar(8.0, 0.8)),
    ];
    let lobes = lobes(habit, stagger, rng);
    let mut laterals = Vec::new();
    for (index, lobe) in lobes.iter().enumerate() {
        let Some(next) = lobes.get(index + 1) else {
            // The last lobe is the tip: its own half ends at the apex.
            let start = Vec2::new(lobe.radius, lobe.centre.y);
            knots.push(Knot { at: start, arrive: Vec2::Y * 0.6, leave: Vec2::Y * 1.11 });
            knots.push(Knot::smooth(Vec2::new(0.0, 1.0), Vec2::NEG_X * 1.11));
            break;
        };
        knots.extend(lobe.knots());
        laterals.push(lobe.centre + polar(lobe.axis_deg, lobe.radius * 0.7));
        let axis_deg = 0.5 * (lobe.axis_deg + next.axis_deg.max(25.0));
        let below =
            if next.axis_deg > 0.0 { next.flank(-1.0) } else { Vec2::new(next.radius, next.centre.y) };
        let middle = (lobe.flank(1.0) + below) / 2.0;
        // Sinuses are deepest half way up.
        let height = ((middle.y + 1.0) / 2.0).clamp(0.0, 1.0);
        let depth = habit.depth * (1.15 - (height - 0.45).abs()) * (1.0 + 0.2 * rng.bell());
        let inner = (habit.width * envelope(height) * (1.0 - depth)).max(0.09);
        let back = ((middle.x - inner) / polar(axis_deg, 1.0).x).max(0.03);
        let notch = middle - polar(axis_deg, back.min(0.35));
        knots.push(Knot::smooth(notch, polar(axis_deg - 90.0, 0.8)));
    }
    Half { margin: through(&knots, 8), laterals, side_ribs: Vec::new() }
}
