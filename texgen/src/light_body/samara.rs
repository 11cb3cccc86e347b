// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The winged seed of a maple: veins bundle along the front edge of the wing and fan out to the back.

use glam::Vec2;

use super::{Drawn, line, mix};
use crate::math::{lerp, smoothstep};
use crate::noise;
use crate::rng::Rng;
use crate::spline::{Knot, through};

/// Middle of the nut.
const NUT: Vec2 = Vec2::new(0.0, -0.74);

pub(super) fn draw(rng: &Rng) -> Drawn {
    let mut shape = rng.fork(1);
    let width = shape.range(0.46, 0.54);
    let bulge = shape.range(0.35, 0.5);
    // Round the nut, up the nearly straight front edge on the right, over the tip and down the bulging back.
    let knots = [
        Knot::smooth(Vec2::new(-0.1, -0.97), Vec2::new(0.9, -0.25)),
        Knot::smooth(Vec2::new(0.16, -0.75), Vec2::new(0.05, 0.9)),
        Knot::smooth(Vec2::new(0.13, -0.2), Vec2::new(0.0, 1.0)),
        Knot::smooth(Vec2::new(0.1, 0.75), Vec2::new(-0.15, 0.9)),
        Knot::smooth(Vec2::new(-0.18, 1.0), Vec2::new(-1.0, -0.2)),
        Knot::smooth(Vec2::new(0.12 - width, bulge), Vec2::new(0.05, -1.0)),
        Knot::smooth(Vec2::new(-0.15, -0.42), Vec2::new(0.15, -0.9)),
        Knot::smooth(Vec2::new(-0.2, -0.75), Vec2::new(-0.05, -0.8)),
        Knot::smooth(Vec2::new(-0.1, -0.97), Vec2::new(0.9, -0.25)),
    ];
    let mut outline = through(&knots, 24);
    outline.pop();
    let seed = shape.bits();
    let ripe = shape.range(0.0, 1.0);
    let colour = move |p: Vec2| {
        let wing = mix([0.46, 0.27, 0.10], [0.38, 0.30, 0.11], ripe);
        let wing = mix(wing, [0.62, 0.45, 0.22], smoothstep(0.1, -0.4, p.x));
        // From the front edge a vein bends backwards, the farther the higher it left.
        let behind = ((0.13 - p.x) / width).max(0.0);
        let foot = p.y - 0.75 * libm::powf(behind, 0.7);
        let bundle = foot * 15.0 + 0.35 * noise::value(seed, p * 5.0);
        let vein = line(bundle - bundle.floor() - 0.5, 0.16) * smoothstep(1.05, 0.6, behind);
        let mottled = 0.06 * noise::fractal(seed ^ 1, p * 9.0, 3);
        let wing = mix(wing, [0.19, 0.10, 0.035], 0.65 * vein).map(|channel| channel * (1.0 + mottled));
        let rib = smoothstep(0.16, 0.02, behind);
        let wing = mix(wing, [0.24, 0.13, 0.05], 0.8 * rib);
        let nut = smoothstep(0.3, 0.2, (p - NUT).length() * lerp(1.0, 0.85, ripe));
        let shine = 0.5 + 0.5 * noise::fractal(seed ^ 2, p * 7.0, 2);
        mix(wing, mix([0.13, 0.075, 0.03], [0.25, 0.16, 0.06], shine), nut)
    };
    Drawn { outline, extras: Vec::new(), colour: Box::new(colour) }
}
