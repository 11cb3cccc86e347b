// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Japanese maple: five to nine narrow lobes with drawn-out tips and finely toothed flanks.

use glam::Vec2;

use crate::math::{lerp, point_along, polar, smoothstep};
use crate::rng::Rng;
use crate::spline::{Knot, resample, through};

/// End of the petiole.
const BASE: Vec2 = Vec2::new(0.0, -1.0);

/// Bearing in degrees and length of each lobe from the midrib outward, by the number of lobes beside the midrib.
const LOBES: [&[(f32, f32)]; 3] = [
    &[(0.0, 1.0), (43.0, 0.92), (91.0, 0.62)],
    &[(0.0, 1.0), (38.0, 0.95), (77.0, 0.76), (121.0, 0.44)],
    &[(0.0, 1.0), (32.0, 0.97), (64.0, 0.86), (98.0, 0.64), (136.0, 0.36)],
];

/// Variation that both halves share.
struct Habit {
    lobes: &'static [(f32, f32)],
    /// Radius of the sinuses as a share of the lobes' length.
    sinus: f32,
    /// Half the greatest width of a lobe as a share of its length.
    breadth: f32,
    /// Height of the teeth.
    teeth: f32,
}

/// A lobe as drawn.
#[derive(Clone, Copy)]
struct Lobe {
    bearing_deg: f32,
    length: f32,
}

/// Right and left half margin of a leaf.
pub(super) fn halves(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let which = [0, 1, 1, 1, 2][shared.integer(0, 4) as usize];
    let crowd = [1.22, 1.0, 0.84][which];
    let habit = Habit {
        lobes: LOBES[which],
        sinus: 0.34 + 0.07 * shared.bell(),
        breadth: (0.145 + 0.02 * shared.bell()) * crowd,
        teeth: 0.017 + 0.006 * shared.bell(),
    };
    (half(&habit, right), half(&habit, left))
}

/// Half margin from the petiole's end to the tip.
fn half(habit: &Habit, rng: &mut Rng) -> Vec<Vec2> {
    let lobes: Vec<Lobe> = habit
        .lobes
        .iter()
        .enumerate()
        .map(|(index, &(bearing_deg, length))| Lobe {
            bearing_deg: if index == 0 { 0.0 } else { bearing_deg + 3.5 * rng.bell() },
            length: if index == 0 { 2.0 } else { 2.0 * length * (1.0 + 0.07 * rng.bell()) },
        })
        .collect();
    let sinus_between = |a: &Lobe, b: &Lobe, turn: f32| {
        let radius = habit.sinus * (0.5 * (a.length + b.length)).min(a.length.min(b.length) * 1.25);
        BASE + polar(lerp(a.bearing_deg, b.bearing_deg, 0.5 + turn), radius)
    };
    let mut margin = vec![BASE];
    let mut from = BASE;
    for index in (0..lobes.len()).rev() {
        let lobe = lobes[index];
        margin.extend(flank(habit, from, lobe, 1.0, rng).into_iter().skip(1));
        if index > 0 {
            let sinus = sinus_between(&lobes[index - 1], &lobe, 0.05 * rng.bell());
            let mut upper = flank(habit, sinus, lobe, -1.0, rng);
            upper.reverse();
            margin.extend(upper.into_iter().skip(1));
            from = sinus;
        }
    }
    margin
}

/// Flank of a lobe from its foot to its tip; `side` is +1 where bearings grow away from the lobe's axis.
fn flank(habit: &Habit, foot: Vec2, lobe: Lobe, side: f32, rng: &mut Rng) -> Vec<Vec2> {
    let at = |share: f32, aside: f32| {
        BASE + polar(lobe.bearing_deg, lobe.length * share)
            + polar(lobe.bearing_deg + 90.0 * side, lobe.length * aside)
    };
    let toward = |turn_deg: f32, pull: f32| polar(lobe.bearing_deg + turn_deg * side, pull);
    let breadth = habit.breadth * (1.0 + 0.1 * rng.bell());
    let widest = 0.5 + 0.05 * rng.bell();
    let foot_turn = if foot == BASE { 55.0 } else { 26.0 };
    let knots = [
        Knot { at: foot, arrive: Vec2::Y, leave: toward(foot_turn, 0.9) },
        Knot::smooth(at(widest, breadth), toward(-4.0, 1.0)),
        Knot::smooth(at(0.8, breadth * 0.4), toward(-16.0, 1.0)),
        Knot { at: at(1.0, 0.0), arrive: toward(-5.0 + 5.0 * rng.bell(), 0.9), leave: Vec2::Y },
    ];
    let smooth = resample(&through(&knots, 16), 240);
    let count = 9 + rng.integer(0, 3);
    let mut out = vec![foot];
    let mut share = 0.14;
    let pieces = [(0.0_f32, 0.0_f32), (0.35, 0.2), (0.7, 0.62), (0.92, 1.0), (0.97, 0.45)];
    out.extend((1..8_u8).map(|i| point_along(&smooth, share * f32::from(i) / 8.0).0));
    for tooth in 0..count {
        let next = share + (0.94 - share) / (count - tooth) as f32 * (1.0 + 0.25 * rng.bell());
        let next = if tooth + 1 == count { 0.94 } else { next };
        let height = habit.teeth * lobe.length * smoothstep(0.05, 0.3, share) * (1.0 + 0.35 * rng.bell());
        for (along, rise) in pieces {
            let (p, heading) = point_along(&smooth, lerp(share, next, along));
            // On the way out, the outside is to the right where bearings grow away from the axis.
            let outward = heading.perp() * -side;
            out.push(p + (outward + heading * 0.9) * height * rise * lerp(1.0, 0.6, share));
        }
        share = next;
    }
    out.extend((0..=4_u8).map(|i| point_along(&smooth, lerp(share, 1.0, f32::from(i) / 4.0)).0));
    out
}
