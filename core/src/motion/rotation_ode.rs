// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rotation equation of Tanabe and Kaneko, as a compatibility mode.
//!
//! ```text
//! dw/dt = -k_a w - 3 pi (rho / (sigma l)) V^2 sin(b) cos(b),   b = alpha + theta
//! ```
//! with theta the leaf's angle from horizontal, alpha the velocity's angle from vertical and V the speed: a Kutta
//! lift at the quarter chord, so that b = 0, broadside to the flow, is stable.
//!
//! # Source
//! Tanabe and Kaneko, "Behavior of a falling paper" (1994), with the power of V and the density ratio that its own
//! derivation gives; later implementations print V^4 and a leaf density. In free fall the quarter-chord torque is
//! 10 to 100 times too large, so [`crate::scene::RotationModel::SpecificForce`] is the default.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2};

use super::constants::{AIR_DENSITY, MotionConstants};
use super::orientation::about_z;
use super::path::Path;

/// Periods integrated before the one that is kept, for the start to be forgotten.
const WARM_UP_PERIODS: usize = 4;
/// Largest step in radians of the pitching at its fastest, and in time constants of the friction. The fourth-order
/// error per radian is then below 1e-6.
const MAX_STEP_RAD: f64 = 0.1;
/// Most steps between two rows, unless so few were unstable.
const MAX_STEPS: f64 = 64.0;
/// Largest step in the same unit that is stable, with some reserve: the method's limit is 2.8.
const STABLE_STEP_RAD: f64 = 2.0;

struct PitchEquation<'a, P> {
    path: &'a P,
    friction_per_s: f64,
    /// `3 pi rho / (sigma l)` in 1/m².
    stiffness_per_m2: f64,
}

impl<P: Path> PitchEquation<'_, P> {
    /// Rate of change of the pitch in rad/s and of its rate in rad/s².
    fn rates(&self, time_s: f64, state: DVec2) -> DVec2 {
        let velocity = self.path.at(time_s).velocity;
        let alpha = libm::atan2(velocity.x, velocity.y);
        let (sin, cos) = libm::sincos(alpha + state.x);
        let speed2 = velocity.x * velocity.x + velocity.y * velocity.y;
        DVec2::new(state.y, -self.friction_per_s * state.y - self.stiffness_per_m2 * speed2 * sin * cos)
    }

    /// State one classical Runge-Kutta step later.
    fn step(&self, time_s: f64, state: DVec2, step_s: f64) -> DVec2 {
        let middle_s = time_s + 0.5 * step_s;
        let k1 = self.rates(time_s, state);
        let k2 = self.rates(middle_s, state + 0.5 * step_s * k1);
        let k3 = self.rates(middle_s, state + 0.5 * step_s * k2);
        let k4 = self.rates(time_s + step_s, state + step_s * k3);
        state + step_s / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    }

    /// Steps between two rows `row_s` apart.
    fn steps(&self, rows: usize, row_s: f64) -> u32 {
        let speed2 = |row: usize| self.path.at(row_s * row as f64).velocity.truncate().length_squared();
        let fastest2 = (0..rows).map(speed2).fold(0.0, f64::max);
        let rate = libm::sqrt(self.stiffness_per_m2 * fastest2).max(self.friction_per_s);
        let most = libm::ceil(rate * row_s / STABLE_STEP_RAD).max(MAX_STEPS);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let steps = libm::ceil(rate * row_s / MAX_STEP_RAD).clamp(1.0, most) as u32;
        steps
    }
}

/// Orientations at `rows + 1` equally spaced times over one period: turns about +z only. What the last period does
/// not close to whole turns is taken back evenly.
pub(super) fn orientations(
    path: &impl Path,
    rows: usize,
    constants: &MotionConstants,
    friction_per_s: f64,
) -> Vec<DQuat> {
    let stiffness_per_m2 = 3.0 * PI * AIR_DENSITY / (constants.areal_density_kg_m2 * constants.size_m);
    let equation = PitchEquation { path, friction_per_s, stiffness_per_m2 };
    let row_s = path.period_s() / rows as f64;
    let steps = equation.steps(rows, row_s);
    let step_s = row_s / f64::from(steps);
    let (mut state, mut pitches) = (DVec2::ZERO, Vec::with_capacity(rows + 1));
    for row in 0..=(WARM_UP_PERIODS + 1) * rows {
        if row >= WARM_UP_PERIODS * rows {
            pitches.push(state.x);
        }
        for step in 0..steps {
            state = equation.step(row as f64 * row_s + f64::from(step) * step_s, state, step_s);
        }
    }
    let residue = pitches[rows] - pitches[0];
    let closing = TAU * libm::round(residue / TAU) - residue;
    let turn = |(row, pitch): (usize, &f64)| about_z(pitch + closing * row as f64 / rows as f64);
    pitches.iter().enumerate().map(turn).collect()
}
