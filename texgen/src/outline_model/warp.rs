// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A random change of shape that cannot fold.
//!
//! In polar coordinates about the blade's centre the radius is stretched by a positive function of the angle, and
//! the angle is moved by a function that keeps its order. Both are one-to-one, so an outline that does not cross
//! itself still does not afterwards.

use glam::Vec2;

use crate::rng::Rng;

/// Waves of the warp around the blade; a lobe of a maple is as wide as one of the sixth.
const WAVES: usize = 7;
/// Exponent by which higher waves are weaker.
const FALL: f32 = 0.7;
/// Share of the amplitude that moves angles.
const TURN: f32 = 0.7;
/// Steepest slope of the angle's shift; at 1 the order of angles would be lost.
const STEEPEST: f32 = 0.6;
/// Bend of the midrib at amplitude 1.
const BEND: f32 = 1.2;

/// A one-to-one map of the plane.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    centre: Vec2,
    stretch: Waves,
    turn: Waves,
    /// Bend along the y axis.
    bend: f32,
    /// Extra length along the y axis, as a logarithm; the width shrinks as much.
    slender: f32,
}

/// Sum of waves over the full circle: cosine and sine weights from the first wave on.
#[derive(Clone, Debug)]
struct Waves([(f32, f32); WAVES]);

impl Waves {
    /// Draws waves with about the given amplitude.
    fn draw(rng: &mut Rng, amplitude: f32) -> Self {
        Self(std::array::from_fn(|n| {
            let height = amplitude * libm::powf((n + 1) as f32, -FALL);
            (height * rng.bell(), height * rng.bell())
        }))
    }

    /// Value at an angle.
    fn at(&self, angle: f32) -> f32 {
        let wave = |(n, (c, s)): (usize, &(f32, f32))| {
            let (sin, cos) = libm::sincosf(angle * (n + 1) as f32);
            c * cos + s * sin
        };
        self.0.iter().enumerate().map(wave).sum()
    }

    /// The same waves with slopes of at most `steepest`.
    fn limited(mut self, steepest: f32) -> Self {
        let wave = |(n, (c, s)): (usize, &(f32, f32))| (n + 1) as f32 * (c * c + s * s).sqrt();
        let slope: f32 = self.0.iter().enumerate().map(wave).sum();
        if slope > steepest {
            self.0.iter_mut().for_each(|(c, s)| {
                *c *= steepest / slope;
                *s *= steepest / slope;
            });
        }
        self
    }
}

impl Warp {
    /// Draws a warp about a centre. `amplitude` is a share of the radius, `slender` a logarithm of length by width.
    pub(super) fn draw(rng: &mut Rng, centre: Vec2, amplitude: f32, slender: f32) -> Self {
        Self {
            centre,
            stretch: Waves::draw(rng, amplitude),
            turn: Waves::draw(rng, TURN * amplitude).limited(STEEPEST),
            bend: BEND * amplitude * rng.bell(),
            slender,
        }
    }

    /// Moves a point.
    pub(super) fn apply(&self, p: Vec2) -> Vec2 {
        let from = p - self.centre;
        let radius = from.length();
        let angle = libm::atan2f(from.y, from.x);
        let (sin, cos) = libm::sincosf(angle + self.turn.at(angle));
        let moved = Vec2::new(cos, sin) * (radius * libm::expf(self.stretch.at(angle)));
        let half = libm::expf(self.slender / 2.0);
        let shaped = Vec2::new(moved.x / half, moved.y * half);
        self.centre + Vec2::new(shaped.x + self.bend * shaped.y * shaped.y, shaped.y)
    }
}
