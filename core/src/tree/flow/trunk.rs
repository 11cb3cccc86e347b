// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The trunk that stands from the start, and draws what grows.
//!
//! It rises straight and then leans towards the middle of all births, which lies on the side of the light, with a slow wander of its own.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::tree::grammar::Draws;

/// Step number of the draws of trunks, which no step of a derivation has.
const TRUNK_DRAWS: u32 = (1 << 17) + 1;
/// Share of the distance to the middle of the births that the trunk leans up to their height.
const LEAN: f64 = 0.85;
/// Amplitude of the wander per height.
const WANDER: f64 = 0.012;
/// Turns of the slower of its two waves from the foot to the top.
const WAVES: f64 = 0.9;

/// Places along a trunk, from the foot on.
#[derive(Clone, Debug)]
pub(super) struct Trunk {
    /// At least the foot.
    pub(super) places: Vec<DVec3>,
    step_m: f64,
}

impl Trunk {
    /// The trunk below births, of a height in m.
    pub(super) fn of(
        births: &[DVec3],
        height_m: f64,
        step_m: f64,
        draws: impl Fn(u32, u32) -> Draws,
    ) -> Self {
        let middle = births.iter().copied().sum::<DVec3>() / (births.len().max(1) as f64);
        let mut draw = draws(TRUNK_DRAWS, 0);
        let phases = [0; 4].map(|_: u8| TAU * draw.unit());
        let wave = |share: f64, [slow, fast]: [f64; 2]| {
            let at = |turns: f64, phase: f64| libm::sin(TAU * turns * share + phase) - libm::sin(phase);
            WANDER * height_m * (at(WAVES, slow) + 0.4 * at(2.3 * WAVES, fast))
        };
        let steps = libm::floor(height_m / step_m);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most 60 m by steps of 0.02 of it"
        )]
        let places = (0..=steps as u32).map(|step| {
            let y = f64::from(step) * step_m;
            let share = y / height_m.max(step_m);
            let level = y / middle.y.max(step_m);
            let lean = 2.0 * LEAN * level * level / (1.0 + level * level);
            let rise = share * share * (3.0 - 2.0 * share);
            let aside = |phases| rise * wave(share, phases);
            DVec3::new(
                middle.x * lean + aside([phases[0], phases[1]]),
                y,
                middle.z * lean + aside([phases[2], phases[3]]),
            )
        });
        Self { places: places.collect(), step_m }
    }

    /// Height in m of its top.
    pub(super) fn top_m(&self) -> f64 {
        self.places[self.places.len() - 1].y
    }

    /// Its place at a height in m, at most its top.
    pub(super) fn at(&self, height_m: f64) -> DVec3 {
        let along = (height_m / self.step_m).clamp(0.0, (self.places.len() - 1) as f64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to its places")]
        let first = along as usize;
        let next = (first + 1).min(self.places.len() - 1);
        self.places[first].lerp(self.places[next], along - first as f64)
    }
}
