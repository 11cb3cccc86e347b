// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Undivided blades: birch, beech, hornbeam and linden differ in their half width and their teeth.

use glam::Vec2;

use crate::math::{lerp, polar, smoothstep};
use crate::rng::Rng;
use crate::spline::{Knot, resample, through};

/// Teeth of a margin.
struct Teeth {
    /// Main teeth on a side.
    main: u32,
    /// Teeth to each main one, itself included.
    per_main: u32,
    /// Height of a main tooth.
    main_height: f32,
    /// Height of the teeth between.
    minor_height: f32,
    /// Lean of the teeth towards the tip, in heights.
    lean: f32,
    /// Part of the margin (0 base, 1 tip) that is toothed.
    span: (f32, f32),
    /// Waves instead of saw teeth.
    wavy: bool,
}

/// Silver birch.
pub(super) fn birch(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let width = 0.74 * (1.0 + 0.13 * shared.bell());
    let shoulder = -0.42 + 0.12 * shared.bell();
    let main = shared.integer(6, 8);
    let draw = |rng: &mut Rng| {
        let w = width * (1.0 + 0.06 * rng.bell());
        let knots = [
            Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(76.0 + 12.0 * rng.bell(), 0.9) },
            Knot::smooth(Vec2::new(w, shoulder + 0.06 * rng.bell()), polar(-8.0, 0.85)),
            Knot::smooth(Vec2::new(0.4 * w, 0.36), polar(-33.0, 1.0)),
            Knot { at: Vec2::new(0.0, 1.0), arrive: polar(-12.0, 0.8), leave: Vec2::Y },
        ];
        let teeth = Teeth {
            main,
            per_main: 3,
            main_height: 0.062,
            minor_height: 0.034,
            lean: 0.75,
            span: (0.16, 0.9),
            wavy: false,
        };
        toothed(&knots, &teeth, rng)
    };
    (draw(right), draw(left))
}

/// Common beech.
pub(super) fn beech(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let width = 0.63 * (1.0 + 0.1 * shared.bell());
    let middle = -0.08 + 0.1 * shared.bell();
    let main = shared.integer(6, 8);
    let draw = |rng: &mut Rng| {
        let w = width * (1.0 + 0.05 * rng.bell());
        let knots = [
            Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(66.0 + 8.0 * rng.bell(), 0.95) },
            Knot::smooth(Vec2::new(w, middle), polar(0.0, 1.05)),
            Knot::smooth(Vec2::new(0.3 * w, 0.78), polar(-42.0, 0.9)),
            Knot { at: Vec2::new(0.0, 1.0), arrive: polar(-25.0, 0.9), leave: Vec2::Y },
        ];
        let teeth = Teeth {
            main,
            per_main: 1,
            main_height: 0.034,
            minor_height: 0.0,
            lean: 0.3,
            span: (0.1, 0.93),
            wavy: true,
        };
        toothed(&knots, &teeth, rng)
    };
    (draw(right), draw(left))
}

/// Common hornbeam.
pub(super) fn hornbeam(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let width = 0.53 * (1.0 + 0.09 * shared.bell());
    let middle = -0.2 + 0.1 * shared.bell();
    let main = shared.integer(11, 14);
    let draw = |rng: &mut Rng| {
        let w = width * (1.0 + 0.05 * rng.bell());
        let knots = [
            Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(80.0 + 12.0 * rng.bell(), 0.95) },
            Knot::smooth(Vec2::new(w, middle), polar(-2.0, 1.0)),
            Knot::smooth(Vec2::new(0.55 * w, 0.5), polar(-28.0, 1.0)),
            Knot { at: Vec2::new(0.0, 1.0), arrive: polar(-15.0, 0.85), leave: Vec2::Y },
        ];
        let teeth = Teeth {
            main,
            per_main: 3,
            main_height: 0.055,
            minor_height: 0.03,
            lean: 0.95,
            span: (0.1, 0.96),
            wavy: false,
        };
        toothed(&knots, &teeth, rng)
    };
    (draw(right), draw(left))
}

/// Linden.
pub(super) fn linden(shared: &mut Rng, right: &mut Rng, left: &mut Rng) -> (Vec<Vec2>, Vec<Vec2>) {
    let width = 0.94 * (1.0 + 0.08 * shared.bell());
    // Linden bases are lopsided: one ear hangs lower than the other.
    let slant = 0.09 * shared.bell();
    let main = shared.integer(6, 7);
    let draw = |rng: &mut Rng, slant: f32| {
        let w = width * (1.0 + 0.05 * rng.bell());
        let ear = Vec2::new(0.42 * w, -1.17 + slant + 0.03 * rng.bell());
        let knots = [
            Knot { at: Vec2::new(0.0, -1.0), arrive: Vec2::Y, leave: polar(142.0, 0.7) },
            Knot::smooth(ear, polar(84.0, 0.95)),
            Knot::smooth(Vec2::new(w, -0.42 + slant), polar(-6.0, 1.0)),
            Knot::smooth(Vec2::new(0.23 * w, 0.62), polar(-40.0, 0.95)),
            Knot { at: Vec2::new(0.0, 1.0), arrive: polar(-10.0, 0.8), leave: Vec2::Y },
        ];
        let teeth = Teeth {
            main,
            per_main: 4,
            main_height: 0.05,
            minor_height: 0.042,
            lean: 0.7,
            span: (0.14, 0.94),
            wavy: false,
        };
        toothed(&knots, &teeth, rng)
    };
    (draw(right, slant), draw(left, -slant))
}

/// Half margin with teeth.
fn toothed(knots: &[Knot], teeth: &Teeth, rng: &mut Rng) -> Vec<Vec2> {
    let smooth = resample(&through(knots, 24), 400);
    let at = |s: f32| crate::math::point_along(&smooth, s);
    let mut margin: Vec<Vec2> = smooth.iter().copied().take_while(|p| p.distance(smooth[0]) < 1e-6).collect();
    let pieces: &[(f32, f32)] = if teeth.wavy {
        &[(0.0, 0.0), (0.2, 0.22), (0.4, 0.55), (0.6, 0.88), (0.75, 1.0), (0.88, 0.62), (0.95, 0.2)]
    } else {
        &[(0.0, 0.0), (0.3, 0.16), (0.6, 0.5), (0.85, 1.0), (0.93, 0.5)]
    };
    let count = teeth.main * teeth.per_main;
    // The tooth borders: even, nudged by up to a fifth of a tooth.
    let border = |tooth: u32, nudge: f32| {
        lerp(teeth.span.0, teeth.span.1, ((tooth as f32 + nudge) / count as f32).clamp(0.0, 1.0))
    };
    let mut from = border(0, 0.0);
    let base_points = 24_u16;
    margin.extend((1..base_points).map(|i| at(from * f32::from(i) / f32::from(base_points)).0));
    for tooth in 0..count {
        let to = border(tooth + 1, if tooth + 1 == count { 0.0 } else { 0.2 * rng.bell() });
        let is_main = (tooth + 1) % teeth.per_main == 0;
        let tall = if is_main { teeth.main_height } else { teeth.minor_height };
        let fade = smoothstep(0.0, 0.12, from) * lerp(1.0, 0.45, smoothstep(0.5, 1.0, from));
        let height = tall * fade * (1.0 + 0.3 * rng.bell());
        for &(fraction, rise) in pieces {
            let (p, along) = at(lerp(from, to, fraction));
            let outward = Vec2::new(along.y, -along.x);
            margin.push(p + (outward + along * teeth.lean) * (height * rise));
        }
        from = to;
    }
    let tip_points = 24_u16;
    margin.extend((0..=tip_points).map(|i| at(lerp(from, 1.0, f32::from(i) / f32::from(tip_points))).0));
    margin
}
