// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The falling plate of Andersen, Pesavento and Wang.
//!
//! ```text
//! I u' = (I + 1) w v - G v - sin(theta) - F_u          G = (2/pi) (-C_T u v / s + C_R w),  s^2 = u^2 + v^2
//! (I + 1) v' = -I w u + G u - cos(theta) - F_v         F = (1/pi) [A - B (u^2 - v^2) / s^2] s (u, v)
//! (I + 1/2) / 4 w' = -u v - (mu_1 + mu_2 |w|) w
//! ```
//! in units of the half chord a and of the speed `V = sqrt((rho_s / rho_f - 1) g b)`, for an ellipse much longer than
//! its thickness 2 b.
//!
//! # Source
//! Andersen, Pesavento and Wang, "Analysis of transitions between fluttering, tumbling and steady descent of falling
//! cards", Journal of Fluid Mechanics 541 (2005), equations 4.7 to 5.3 in the limit of a thin plate.

use std::f64::consts::PI;

use super::{PlateState, world_velocity};

/// A thin plate that falls in a plane; every number is dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallingPlate {
    /// Moment of inertia I, `b rho_s / (a rho_f)`.
    pub inertia: f64,
    /// Circulation by translation `C_T`.
    pub translation: f64,
    /// Circulation by rotation `C_R`.
    pub rotation: f64,
    /// Mean drag A.
    pub drag_mean: f64,
    /// Spread B of the drag between broadside and edge-on.
    pub drag_spread: f64,
    /// Damping of the rotation: its linear part `mu_1` and its quadratic part `mu_2`.
    pub damping: [f64; 2],
}

impl FallingPlate {
    /// The published coefficients with a moment of inertia `inertia`.
    #[must_use]
    pub fn new(inertia: f64) -> Self {
        Self {
            inertia,
            translation: 1.2,
            rotation: PI,
            drag_mean: 1.4,
            drag_spread: 1.0,
            damping: [0.2, 0.2],
        }
    }

    /// Rate of change of the state.
    #[must_use]
    pub fn rates(&self, state: &PlateState) -> PlateState {
        let &[u, v, turning, pitch, _, _] = state;
        let (sin, cos) = libm::sincos(pitch);
        let square = u * u + v * v;
        // A plate at rest feels no flow; the floor only keeps 0 / 0 out.
        let speed = libm::sqrt(square).max(f64::MIN_POSITIVE);
        let circulation = 2.0 / PI * (-self.translation * u * v / speed + self.rotation * turning);
        let drag = (self.drag_mean - self.drag_spread * (u * u - v * v) / square.max(f64::MIN_POSITIVE))
            * speed
            / PI;
        let [linear, quadratic] = self.damping;
        let inertia = self.inertia;
        let along = ((inertia + 1.0) * turning * v - circulation * v - sin - drag * u) / inertia;
        let normal = (-inertia * turning * u + circulation * u - cos - drag * v) / (inertia + 1.0);
        let torque = -u * v - (linear + quadratic * turning.abs()) * turning;
        let (across, up) = world_velocity(u, v, pitch);
        [along, normal, 4.0 * torque / (inertia + 0.5), turning, across, up]
    }
}
