// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Norway maple: five lobes with drawn-out side teeth and rounded sinuses.

use glam::Vec2;

use crate::math::polar;
use crate::rng::Rng;
use crate::spline::{Knot, through};

/// A tip or a sinus of the half margin, as seen from the petiole.
struct Mark {
    /// Bearing from the petiole's end in degrees, 0 along the midrib.
    bearing_deg: f32,
    /// Distance from the petiole's end, 1 at the leaf's tip.
    radius: f32,
    /// For a tip, the bearing in which it points; `None` for a sinus.
    axis_deg: Option<f32>,
    /// Rib (0 midrib, 1 side lobe, 2 basal lobe) that the mark belongs to.
    rib: usize,
}

/// Tip of a tooth or lobe.
const fn tip(rib: usize, bearing_deg: f32, radius: f32, axis_deg: f32) -> Mark {
    Mark { bearing_deg, radius, axis_deg: Some(axis_deg), rib }
}

/// Sinus between two tips.
const fn sinus(rib: usize, bearing_deg: f32, radius: f32) -> Mark {
    Mark { bearing_deg, radius, axis_deg: None, rib }
}

/// Half margin from the base to the tooth below the leaf's tip.
const MARKS: [Mark; 15] = [
    tip(2, 127.0, 0.40, 133.0),
    sinus(2, 114.0, 0.37),
    tip(2, 102.0, 0.68, 104.0),
    sinus(2, 93.0, 0.49),
    tip(2, 86.0, 0.55, 78.0),
    sinus(1, 76.0, 0.43),
    tip(1, 67.0, 0.71, 82.0),
    sinus(1, 59.5, 0.66),
    tip(1, 50.0, 0.94, 52.0),
    sinus(1, 43.0, 0.72),
    tip(1, 37.5, 0.79, 24.0),
    sinus(0, 25.0, 0.45),
    tip(0, 22.5, 0.68, 40.0),
    sinus(0, 15.5, 0.68),
    tip(0, 12.5, 0.83, 21.0),
];

/// Variation that both halves share.
struct Habit {
    /// Factor on every sinus radius: below 1 the lobes are deeper.
    sinus: f32,
    /// Factor on bearings: how far the lobes spread.
    spread: f32,
    /// Factor on the distance by which teeth stand out of the line between their sinuses.
    teeth: f32,
}

/// Right and left half margin of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let habit = Habit {
        sinus: 1.0 + 0.1 * shared.bell(),
        spread: 1.0 + 0.05 * shared.bell(),
        teeth: 1.0 + 0.25 * shared.bell(),
    };
    (half(&habit, right), half(&habit, left))
}

/// Half margin from the petiole's end to the tip.
fn half(habit: &Habit, rng: &mut Rng) -> Vec<Vec2> {
    let origin = Vec2::new(0.0, -1.0);
    let place = |bearing_deg: f32, radius: f32| origin + polar(bearing_deg, 2.0 * radius);
    let lobe_turn = [0.0, 3.5 * rng.bell(), 5.0 * rng.bell()];
    let lobe_length = [1.0, 1.0 + 0.07 * rng.bell(), 1.0 + 0.12 * rng.bell()];
    let mut knots = vec![Knot { at: origin, arrive: Vec2::Y, leave: polar(138.0 + 14.0 * rng.bell(), 0.8) }];
    for mark in &MARKS {
        let bearing = mark.bearing_deg * habit.spread + lobe_turn[mark.rib] + 1.1 * rng.bell();
        let stretch = lobe_length[mark.rib];
        if let Some(axis_deg) = mark.axis_deg {
            let side_tooth = mark.radius < 0.8 && !(mark.rib == 2 && mark.radius > 0.6);
            let tooth = if side_tooth { 0.03 * (habit.teeth - 1.0) / 0.25 } else { 0.0 };
            let radius = (mark.radius + tooth) * stretch * (1.0 + 0.035 * rng.bell());
            let at = place(bearing, radius);
            let axis = polar(axis_deg + lobe_turn[mark.rib] + 6.0 * rng.bell(), 0.85);
            knots.push(Knot::pointed(at, axis));
        } else {
            let radius = mark.radius * habit.sinus * stretch * (1.0 + 0.04 * rng.bell());
            let along = polar(bearing - 90.0 + 8.0 * rng.bell(), 0.75);
            knots.push(Knot::smooth(place(bearing, radius), along));
        }
    }
    knots.push(Knot::pointed(Vec2::new(0.0, 1.0), Vec2::Y * 0.85));
    through(&knots, 10)
}
