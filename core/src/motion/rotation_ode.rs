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

use glam::DQuat;
use ode_solvers::{Dopri5, System, Vector2};

use super::constants::{AIR_DENSITY, MotionConstants};
use super::orientation::about_z;
use super::path::Path;

/// Periods integrated before the one that is kept, for the start to be forgotten.
const WARM_UP_PERIODS: f64 = 4.0;
/// Relative and absolute tolerance of the adaptive integration.
const TOLERANCE: f64 = 1e-9;

struct PitchEquation<'a, P> {
    path: &'a P,
    friction_per_s: f64,
    /// `3 pi rho / (sigma l)` in 1/m².
    stiffness_per_m2: f64,
}

impl<P: Path> System<f64, Vector2<f64>> for PitchEquation<'_, P> {
    fn system(&self, time: f64, state: &Vector2<f64>, slope: &mut Vector2<f64>) {
        let velocity = self.path.at(time).velocity;
        let alpha = libm::atan2(velocity.x, velocity.y);
        let (sin, cos) = libm::sincos(alpha + state[0]);
        slope[0] = state[1];
        slope[1] = -self.friction_per_s * state[1]
            - self.stiffness_per_m2 * (velocity.x * velocity.x + velocity.y * velocity.y) * sin * cos;
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
    let equation = PitchEquation {
        path,
        friction_per_s,
        stiffness_per_m2: 3.0 * PI * AIR_DENSITY / (constants.areal_density_kg_m2 * constants.size_m),
    };
    let period = path.period_s();
    let end = (WARM_UP_PERIODS + 1.0) * period;
    let step = period / rows as f64;
    let mut solver = Dopri5::new(equation, 0.0, end, step, Vector2::new(0.0, 0.0), TOLERANCE, TOLERANCE);
    // A failing integration leaves its results short; the rows it lacks repeat its last angle.
    let _ = solver.integrate();
    let first = WARM_UP_PERIODS * rows as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small positive whole number"
    )]
    let angle = |row: usize| {
        let angles = solver.y_out();
        angles.get(first as usize + row).or(angles.last()).map_or(0.0, |state| state[0])
    };
    let residue = angle(rows) - angle(0);
    let closing = TAU * libm::round(residue / TAU) - residue;
    (0..=rows).map(|row| about_z(angle(row) + closing * row as f64 / rows as f64)).collect()
}
