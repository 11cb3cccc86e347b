// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bends a whole leaf a little, so that even its midrib is not straight.

use glam::Vec2;

use crate::noise;
use crate::rng::Rng;

/// A smooth displacement of the plane that keeps the petiole's end in place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// Sideways shift of the tip.
    bend: f32,
    /// Sideways swing half way up.
    swing: f32,
    /// Greatest random shift.
    wander: f32,
    /// Seed of the random shift.
    seed: u64,
}

impl Bend {
    /// Draws a bend.
    pub(super) fn draw(rng: &mut Rng) -> Self {
        Self { bend: 0.16 * rng.bell(), swing: 0.06 * rng.bell(), wander: 0.05, seed: rng.bits() }
    }

    /// Moves a point.
    pub(super) fn apply(&self, p: Vec2) -> Vec2 {
        let up = ((p.y + 1.0) / 2.0).max(0.0);
        let shift = |seed: u64, at: Vec2| noise::value(self.seed ^ seed, at * 1.3 + Vec2::splat(40.0));
        let base = Vec2::new(0.0, -1.0);
        let wander = Vec2::new(shift(1, p) - shift(1, base), shift(2, p) - shift(2, base)) * self.wander;
        p + wander + Vec2::new(self.bend * up * up + self.swing * up * (1.0 - up) * 4.0 * up, 0.0)
    }
}
