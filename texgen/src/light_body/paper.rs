// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scrap torn from a ruled page: one straight cut edge, three torn ones with a paler fringe.

use glam::Vec2;

use super::{Drawn, line, mix};
use crate::math::{lerp, segment_distance, smoothstep};
use crate::noise;
use crate::rng::Rng;

/// Points of each torn edge.
const STEPS: u16 = 48;
/// Distance of the ruled lines, and width of the fringe that tearing frays.
const RULE: f32 = 0.3;
const FRINGE: f32 = 0.035;

pub(super) fn draw(rng: &Rng) -> Drawn {
    let mut shape = rng.fork(1);
    let half_length = shape.range(0.9, 1.0);
    let half_width = half_length / shape.range(1.2, 1.45);
    let skew = |rng: &mut Rng| Vec2::new(0.06 * rng.bell(), 0.08 * rng.bell());
    let corners = [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| Vec2::new(x * half_width, y * half_length) + skew(&mut shape));
    let mut outline = Vec::new();
    for (edge, seed) in [shape.bits(), shape.bits(), shape.bits()].into_iter().enumerate() {
        let (from, to) = (corners[edge], corners[edge + 1]);
        let aside = (to - from).normalize_or(Vec2::Y).perp();
        for step in 0..STEPS {
            let t = f32::from(step) / f32::from(STEPS);
            let fixed = (t * (1.0 - t) * 4.0).sqrt();
            let torn = 0.09 * noise::fractal(seed, Vec2::new(3.0 * t, 0.5), 2)
                + 0.02 * noise::fractal(seed ^ 1, Vec2::new(22.0 * t, 0.5), 2);
            outline.push(from.lerp(to, t) + aside * (torn * fixed));
        }
    }
    outline.push(corners[3]);
    let torn: Vec<Vec2> = outline.clone();
    let (grain, tilt) = (shape.bits(), 0.06 * shape.bell());
    let colour = move |p: Vec2| {
        let fibre = 0.03 * noise::fractal(grain, p * 26.0, 3) + 0.025 * noise::fractal(grain ^ 1, p * 4.0, 2);
        let paper = [0.86, 0.86, 0.83].map(|channel| channel + fibre);
        let rule = (p.y + tilt * p.x) / RULE;
        let ruled = mix(paper, [0.35, 0.47, 0.72], 0.7 * line((rule - rule.floor() - 0.5) * RULE, 0.022));
        let edge = torn.windows(2).map(|ends| segment_distance(p, ends[0], ends[1]).0).fold(1.0, f32::min);
        mix([0.93; 3], ruled, lerp(0.1, 1.0, smoothstep(0.4 * FRINGE, FRINGE, edge)))
    };
    Drawn { outline, extras: Vec::new(), colour: Box::new(colour) }
}
