// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pedunculate oak: rounded lobes along an obovate blade, small ears at the base.

use glam::Vec2;

use crate::math::{lerp, polar, smoothstep};
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
    /// Height of the widest place, 0 base to 1 tip.
    widest: f32,
}

/// A lobe: where it ends and in which bearing it points.
struct Lobe {
    apex: Vec2,
    axis_deg: f32,
    /// Room along the margin.
    breadth: f32,
}

/// Right and left half margin of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let habit = Habit {
        width: 0.56 + 0.1 * shared.bell(),
        depth: 0.27 + 0.12 * shared.bell(),
        lobes: [3, 4, 4, 4, 5][shared.integer(0, 4) as usize],
        stagger: shared.range(0.1, 0.55),
        widest: 0.62 + 0.07 * shared.bell(),
    };
    (half(&habit, 0.0, right), half(&habit, habit.stagger, left))
}

impl Habit {
    /// Half width of the lobes' ends at a height (0 base, 1 tip): a wedge that swells late and rounds off.
    fn envelope(&self, height: f32) -> f32 {
        let rise = smoothstep(-0.25, self.widest, height);
        let fall = smoothstep(1.32, self.widest + 0.05, height);
        self.width * (0.12 + 0.88 * rise * rise.sqrt()) * lerp(0.15, 1.0, fall)
    }
}

/// Lobes of one half from the base up, without the tip.
fn lobes(habit: &Habit, stagger: f32, rng: &mut Rng) -> Vec<Lobe> {
    let count = habit.lobes as f32;
    let mut lobes = Vec::new();
    for lobe in 0..habit.lobes {
        // Lobes crowd towards the tip.
        let place = (lobe as f32 + 0.62 + stagger * 0.5 + 0.11 * rng.bell()) / (count + 0.55);
        let height = lerp(0.1, 0.95, libm::powf(place, 0.88));
        let axis_deg = lerp(76.0, 34.0, height) + 6.0 * rng.bell();
        let reach = habit.envelope(height) * (1.0 + 0.12 * rng.bell());
        let breadth = 1.6 / count * lerp(0.75, 1.0, habit.envelope(height) / habit.width);
        lobes.push(Lobe { apex: Vec2::new(reach, 2.0 * height - 1.0), axis_deg, breadth });
    }
    lobes
}

/// The margin over one lobe: a broad, slightly lopsided round.
fn over(lobe: &Lobe, rng: &mut Rng) -> [Knot; 3] {
    let axis = polar(lobe.axis_deg, 1.0);
    let across = polar(lobe.axis_deg - 90.0, 1.0);
    let half = lobe.breadth * 0.27 * rng.range(0.85, 1.15);
    // The lower shoulder falls back less than the upper one: lobes lean forward.
    let lower = lobe.apex - across * half - axis * half * rng.range(0.25, 0.45);
    let upper = lobe.apex + across * half * 0.9 - axis * half * rng.range(0.35, 0.65);
    [
        Knot::smooth(lower, polar(lobe.axis_deg - 42.0, 0.95)),
        Knot::smooth(lobe.apex, polar(lobe.axis_deg - 90.0 + 8.0 * rng.bell(), 1.0)),
        Knot::smooth(upper, polar(lobe.axis_deg - 142.0, 0.95)),
    ]
}

/// Half margin from the petiole's end to the tip.
fn half(habit: &Habit, stagger: f32, rng: &mut Rng) -> Vec<Vec2> {
    // The ear at the base curls back to the petiole.
    let ear = 0.075 + 0.025 * rng.bell();
    let mut knots = vec![
        Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(104.0, 0.8) },
        Knot::smooth(Vec2::new(ear, -0.965), polar(20.0, 0.9)),
        Knot::smooth(Vec2::new(ear * 1.02, -0.88), polar(-4.0, 0.9)),
    ];
    let lobes = lobes(habit, stagger, rng);
    let tip = habit.width * rng.range(0.5, 0.66);
    let mut below = Vec2::new(ear, -0.88);
    for (index, lobe) in lobes.iter().enumerate() {
        if index > 0 {
            knots.push(sinus(habit, below, lobe, rng));
        }
        knots.extend(over(lobe, rng));
        below = knots[knots.len() - 1].at;
    }
    // The last lobe is the tip: its own half ends at the apex.
    let shoulder = rng.range(0.74, 0.82);
    let crown = Lobe { apex: Vec2::new(tip, shoulder), axis_deg: 42.0, breadth: tip };
    knots.push(sinus(habit, below, &crown, rng));
    knots.push(Knot::smooth(Vec2::new(tip, shoulder), polar(-22.0, 1.0)));
    // A shallow dent parts the crown's side from its top.
    let dent = Vec2::new(tip * 0.62, 0.5 * (1.0 + shoulder) + 0.01 * rng.bell());
    knots.push(Knot::smooth(dent, polar(-40.0 + 10.0 * rng.bell(), 0.9)));
    knots.push(Knot::smooth(Vec2::new(tip * 0.32, 0.985), polar(-66.0, 1.0)));
    knots.push(Knot::smooth(Vec2::new(0.0, 1.0), polar(-90.0, 0.9)));
    through(&knots, 8)
}

/// Rounded bottom between a lobe's upper end and the next lobe; deepest half way up, where the blade is broad.
fn sinus(habit: &Habit, below: Vec2, next: &Lobe, rng: &mut Rng) -> Knot {
    let foot = next.apex - polar(next.axis_deg - 90.0, next.breadth * 0.2) - polar(next.axis_deg, 0.06);
    let middle = below.lerp(foot, 0.5);
    let height = ((middle.y + 1.0) / 2.0).clamp(0.0, 1.0);
    let profile = smoothstep(0.0, 0.4, height) * lerp(1.0, 0.5, smoothstep(0.6, 1.0, height));
    let depth = habit.depth * lerp(0.55, 1.15, profile) * (1.0 + 0.3 * rng.bell());
    let axis_deg = next.axis_deg + 10.0;
    let room = (middle.x - 0.1) / polar(axis_deg, 1.0).x.max(0.2);
    let back = (depth * habit.envelope(height)).min(room).max(0.015);
    Knot::smooth(middle - polar(axis_deg, back), polar(axis_deg - 90.0 + 6.0 * rng.bell(), 0.8))
}
