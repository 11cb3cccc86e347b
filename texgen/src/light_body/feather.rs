// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A contour feather: a curved shaft, a vane whose barbs part here and there, down at its foot.

use std::f32::consts::PI;

use glam::Vec2;

use super::{Drawn, line, mix};
use crate::math::{lerp, smoothstep};
use crate::noise;
use crate::raster::stroke;
use crate::rng::Rng;

/// Points of each side of the vane.
const STEPS: u16 = 160;
/// Foot of the vane; its tip is at 1, the quill's end at -1.
const FOOT: f32 = -0.66;
/// Rise of the barbs on their way out, per width.
const RISE: f32 = 0.75;

/// A gap between barbs.
#[derive(Clone, Copy)]
struct Split {
    at: f32,
    depth: f32,
    width: f32,
}

pub(super) fn draw(rng: &Rng) -> Drawn {
    let mut shape = rng.fork(1);
    let bend = shape.range(0.06, 0.14);
    let half_width = shape.range(0.27, 0.31);
    let narrow = shape.range(0.72, 0.85);
    let mut outline = side(half_width, bend, 1.0, &mut rng.fork(2));
    let other = side(half_width * narrow, bend, -1.0, &mut rng.fork(3));
    outline.extend(other.into_iter().rev().skip(1));
    let shaft: Vec<(Vec2, f32)> = (0..=24u16)
        .map(|i| {
            let y = lerp(-1.0, 0.9, f32::from(i) / 24.0);
            (Vec2::new(shaft_x(bend, y), y), lerp(0.021, 0.004, (y + 1.0) / 1.9))
        })
        .collect();
    let (grain, shade) = (shape.bits(), shape.range(0.0, 1.0));
    let colour = move |p: Vec2| {
        let across = p.x - shaft_x(bend, p.y);
        // Barbs run out and up; each is a little lighter or darker than the next.
        let barb = p.y - RISE * across.abs();
        let barbs = noise::fractal(grain, Vec2::new(barb * 42.0, 3.0 * across), 2);
        let dark = mix([0.16, 0.16, 0.18], [0.30, 0.24, 0.18], shade);
        let banded = 0.5 + 0.5 * libm::sinf(9.0 * barb + 2.0 * shade);
        let vane = mix(dark, [0.62, 0.61, 0.60], 0.35 + 0.4 * banded + 0.22 * barbs);
        let down = smoothstep(FOOT + 0.45, FOOT + 0.1, barb);
        let vane = mix(vane, [0.82, 0.82, 0.82], down);
        let radius = lerp(0.03, 0.008, (p.y + 1.0) / 2.0);
        mix(vane, [0.85, 0.80, 0.68], line(across, radius))
    };
    Drawn { outline, extras: vec![stroke(&shaft)], colour: Box::new(colour) }
}

/// Place of the shaft at a height.
fn shaft_x(bend: f32, y: f32) -> f32 {
    bend * (y * y - 0.5)
}

/// One side of the vane from foot to tip, `sign` 1 on the right.
fn side(half_width: f32, bend: f32, sign: f32, rng: &mut Rng) -> Vec<Vec2> {
    let splits: Vec<Split> = (0..rng.integer(2, 4))
        .map(|_| Split {
            at: rng.range(0.3, 0.9),
            depth: rng.range(0.35, 0.8),
            width: rng.range(0.004, 0.012),
        })
        .collect();
    let (seed, fluff) = (rng.bits(), rng.bits());
    let point = |step: u16| {
        let t = f32::from(step) / f32::from(STEPS);
        // Broad above the middle, blunt at both ends.
        let profile = libm::powf(libm::sinf(PI * libm::powf(t, 0.85)).max(0.0), 0.55) * lerp(0.8, 1.0, t);
        let ruffled = 1.0
            + 0.03 * noise::fractal(seed, Vec2::new(t * 14.0, 0.5), 2)
            + 0.35 * smoothstep(0.22, 0.0, t) * noise::value(fluff, Vec2::new(t * 90.0, 0.5));
        let gap = splits
            .iter()
            .map(|split| split.depth * (1.0 - ((t - split.at).abs() / split.width).min(1.0)))
            .fold(0.0, f32::max);
        let out = half_width * profile * ruffled * (1.0 - gap);
        // Along its barb: what lies farther in lies lower.
        let y = lerp(FOOT, 1.0, t) - RISE * half_width * profile * gap * 0.6;
        Vec2::new(shaft_x(bend, y) + sign * out.max(0.0), y)
    };
    (0..=STEPS).map(point).collect()
}
