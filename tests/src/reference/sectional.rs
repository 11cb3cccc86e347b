// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The section of a thin plate with lift that stalls and a centre of pressure that moves.
//!
//! With the incidence `alpha` from 0 (edge-on) to pi/2 (broadside) and the attached share
//! `q = [1 - tanh((alpha - 14 deg) / 6 deg)] / 2`:
//! ```text
//! C_L = q 5.2 sin(alpha) + (1 - q) 0.95 sin(2 alpha)
//! C_D = q (0.1 + 5.0 sin^2 alpha) + (1 - q) 1.9 sin^2 alpha
//! l_cp / l = q (0.3 - 3.5 alpha^2) + (1 - q) 0.2 (1 - 2 alpha / pi)
//! lift = rho l (C_L s - 1.1 l w) / 2, across the velocity;  torque of rotation = -(1.9 / 64) rho l^4 w |w|
//! added mass along the normal pi rho l^2 / 4, added moment of inertia pi rho l^4 / 128
//! ```
//! Only the lift of translation and the drag act at the centre of pressure; the lift of rotation acts at the middle.
//!
//! # Source
//! Li, Goodwill, Wang and Ristroph, "Centre of mass location, flight modes, stability and dynamic modelling of
//! gliders", Journal of Fluid Mechanics 937 (2022); Pomerenk and Ristroph, arXiv 2408.08864 (2024).

use std::f64::consts::{FRAC_PI_2, PI};

use super::{PlateState, world_velocity};
use windfall_core::motion::AIR_DENSITY;
use windfall_core::scene::STANDARD_GRAVITY_M_S2;

/// Incidence at which half of the flow has separated, rad.
const STALL: f64 = 14.0 * PI / 180.0;
/// Spread of the stall over incidences, rad.
const STALL_WIDTH: f64 = 6.0 * PI / 180.0;
/// Lift of rotation `C_R`.
const ROTATIONAL_LIFT: f64 = 1.1;
/// Drag of a plate broadside.
const BROADSIDE_DRAG: f64 = 1.9;

/// A unit width of a flat plate in still air, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionalPlate {
    /// Chord in m.
    pub chord_m: f64,
    /// Areal density in kg/m².
    pub areal_density_kg_m2: f64,
}

/// Coefficients at an incidence: lift, drag, and the centre of pressure in chords ahead of the middle.
struct Section {
    lift: f64,
    drag: f64,
    centre: f64,
}

/// The coefficients of the module's description.
fn section(incidence: f64) -> Section {
    let sin = libm::sin(incidence);
    let attached = 0.5 * (1.0 - libm::tanh((incidence - STALL) / STALL_WIDTH));
    let blend = |before: f64, after: f64| attached * before + (1.0 - attached) * after;
    Section {
        lift: blend(5.2 * sin, 0.95 * libm::sin(2.0 * incidence)),
        drag: blend(0.1 + 5.0 * sin * sin, BROADSIDE_DRAG * sin * sin),
        centre: blend(0.3 - 3.5 * incidence * incidence, 0.2 * (1.0 - incidence / FRAC_PI_2)),
    }
}

impl SectionalPlate {
    /// Rate of change of the state, in m/s², rad/s², rad/s and m/s.
    #[must_use]
    pub fn rates(&self, state: &PlateState) -> PlateState {
        let &[along, normal, turning, pitch, _, _] = state;
        let chord = self.chord_m;
        let mass = self.areal_density_kg_m2 * chord;
        let added_mass = PI / 4.0 * AIR_DENSITY * chord * chord;
        let inertia = mass * chord * chord / 12.0 + PI / 128.0 * AIR_DENSITY * libm::pow(chord, 4.0);

        let speed = libm::sqrt(along * along + normal * normal);
        let Section { lift, drag, centre } = section(libm::atan2(normal.abs(), along.abs()));
        let pressure = 0.5 * AIR_DENSITY * chord;
        // Lift is the velocity turned by a quarter turn, towards the side the plate is pushed to.
        let side = if along * normal > 0.0 { -1.0 } else { 1.0 };
        let translation = pressure * lift * speed * side;
        let circulation = translation + pressure * ROTATIONAL_LIFT * chord * turning;
        let resistance = pressure * drag * speed;

        let weight = mass * f64::from(STANDARD_GRAVITY_M_S2);
        let (sin, cos) = libm::sincos(pitch);
        let force_along = -circulation * normal - resistance * along - weight * sin;
        let force_normal = circulation * along - resistance * normal - weight * cos;
        let lever = centre * chord * if along < 0.0 { -1.0 } else { 1.0 };
        let torque = lever * (translation * along - resistance * normal)
            - BROADSIDE_DRAG / 64.0 * AIR_DENSITY * libm::pow(chord, 4.0) * turning * turning.abs();

        let (across, up) = world_velocity(along, normal, pitch);
        [
            ((mass + added_mass) * turning * normal + force_along) / mass,
            (-mass * turning * along + force_normal) / (mass + added_mass),
            torque / inertia,
            turning,
            across,
            up,
        ]
    }
}
