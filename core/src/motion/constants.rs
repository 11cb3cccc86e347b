// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of the primitive motions in SI units, from a species' size and mass.

use std::f64::consts::TAU;

use crate::scene::{ConeShape, STANDARD_GRAVITY_M_S2, Species};

/// Density of air in kg/m³ at 20 °C.
pub const AIR_DENSITY: f64 = 1.2;

/// Areal density of the paper that the scalings were measured with, kg/m².
const REFERENCE_AREAL_DENSITY: f64 = 0.070;

/// Mean descent speed of that paper in m/s at standard gravity, independent of size.
const REFERENCE_DESCENT: f64 = 0.757;

/// Turns per second times diameter over descent speed, tumbling.
const TUMBLE_NUMBER: f64 = 0.20;

/// Swings per second times diameter over descent speed, fluttering.
const FLUTTER_NUMBER: f64 = 0.10;

/// Everything the equations of the primitive motions need.
///
/// # Source
/// Scalings fitted to 380 drops of paper pieces by Howison, Hughes and Iida (2020): `U = 0.757 sqrt(sigma/0.070)`,
/// with the root of gravity by the balance of weight and drag; tumbling `0.20 U/d` turns/s, swinging `0.10 U/d`, amplitudes `Ax = 1.05 U`, `Ay = 0.7 U` (0.3 U under 5 cm).
/// Numbers of spirals, wandering, chaos and corner swings are modelling choices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionConstants {
    /// Acceleration of gravity g in m/s².
    pub gravity_m_s2: f64,
    /// Diameter d in metres.
    pub size_m: f64,
    /// Areal density sigma in kg/m².
    pub areal_density_kg_m2: f64,
    /// Mean descent speed U in m/s.
    pub descent_m_s: f64,
    /// Horizontal velocity amplitude Ax in m/s.
    pub horizontal_m_s: f64,
    /// Vertical velocity amplitude Ay in m/s.
    pub vertical_m_s: f64,
    /// Angular rate of fluttering in rad/s.
    pub flutter_rad_s: f64,
    /// Angular rate of tumbling in rad/s.
    pub tumble_rad_s: f64,
    /// Unevenness of the tumbling rotation.
    pub tumble_wobble: f64,
    /// Chance that chaotic motion keeps its direction at a turning point.
    pub chaos_keep: f64,
    /// Relative half width of the chaotic redraws.
    pub chaos_jitter: f64,
    /// Petal length of the rose in metres.
    pub rose_radius_m: f64,
    /// Ratio of the rose's axes.
    pub rose_ellipticity: f64,
    /// Swings per precession of the rose.
    pub rose_swings: u32,
    /// Radius of the spiral in metres.
    pub spiral_radius_m: f64,
    /// Orbit rate of the spiral in rad/s.
    pub spiral_rad_s: f64,
    /// Surface that the cone spiral lies on.
    pub cone_shape: ConeShape,
    /// Radius R of the cone spiral in metres, where it is open.
    pub cone_radius_m: f64,
    /// Depth H below its tip in metres at which it is.
    pub cone_depth_m: f64,
    /// Orbit rate of the cone spiral in rad/s.
    pub cone_rad_s: f64,
    /// Largest difference of its descent speed from U, as a share of U.
    pub cone_unevenness: f64,
    /// Amplitude of the corner swing in radians.
    pub corner_swing_rad: f64,
    /// Angular rate of the corner swing in rad/s.
    pub corner_swing_rad_s: f64,
    /// Standard deviation of the wandering in m/s.
    pub wander_m_s: f64,
    /// Correlation time of the wandering in seconds.
    pub wander_s: f64,
}

impl MotionConstants {
    /// Numbers of a species: what it states itself, else what size, mass and gravity give.
    pub fn of(species: &Species, gravity_m_s2: f32) -> Self {
        let given = &species.motion;
        let or = |value: Option<f32>, default: f64| value.map_or(default, f64::from);
        let size_m = f64::from(species.size_m);
        let areal_density_kg_m2 = f64::from(species.areal_density_kg_m2);
        let gravity_m_s2 = f64::from(gravity_m_s2);
        let weight =
            areal_density_kg_m2 / REFERENCE_AREAL_DENSITY * gravity_m_s2 / f64::from(STANDARD_GRAVITY_M_S2);
        let scaled = REFERENCE_DESCENT * libm::sqrt(weight);
        let descent_m_s = or(given.descent_m_s, scaled);
        let horizontal_m_s = or(given.horizontal_m_s, 1.05 * descent_m_s);
        // Small pieces heave little: 0.3 U below 5 cm, 0.7 U from 7 cm on.
        let heave = 0.3 + 0.4 * ((size_m - 0.05) / 0.02).clamp(0.0, 1.0);
        let flutter_rad_s = or(given.flutter_rad_s, TAU * FLUTTER_NUMBER * descent_m_s / size_m);
        let spiral_rad_s = or(given.spiral_rad_s, (0.65 * flutter_rad_s).clamp(3.0, 8.0));
        Self {
            gravity_m_s2,
            size_m,
            areal_density_kg_m2,
            descent_m_s,
            horizontal_m_s,
            vertical_m_s: or(given.vertical_m_s, heave * descent_m_s),
            flutter_rad_s,
            tumble_rad_s: or(given.tumble_rad_s, TAU * TUMBLE_NUMBER * descent_m_s / size_m),
            tumble_wobble: or(given.tumble_wobble, 0.3),
            chaos_keep: or(given.chaos_keep, 0.6),
            chaos_jitter: or(given.chaos_jitter, 0.15),
            rose_radius_m: or(given.rose_radius_m, horizontal_m_s / flutter_rad_s),
            rose_ellipticity: or(given.rose_ellipticity, 0.15),
            rose_swings: given.rose_swings.unwrap_or(4),
            spiral_radius_m: or(
                given.spiral_radius_m,
                (0.9 * horizontal_m_s / spiral_rad_s).clamp(0.05, 0.3),
            ),
            spiral_rad_s,
            cone_shape: given.cone_shape.unwrap_or_default(),
            cone_radius_m: or(given.cone_radius_m, 0.6),
            cone_depth_m: or(given.cone_depth_m, 3.0),
            cone_rad_s: or(given.cone_rad_s, (0.35 * flutter_rad_s).clamp(1.5, 4.0)),
            cone_unevenness: or(given.cone_unevenness, 0.3),
            corner_swing_rad: or(given.corner_swing_deg, 30.0).to_radians(),
            corner_swing_rad_s: or(given.corner_swing_rad_s, flutter_rad_s),
            wander_m_s: or(given.wander_m_s, 0.03),
            wander_s: or(given.wander_s, 0.2),
        }
    }

    /// Time constant in seconds in which a leaf takes on the wind's velocity: `U/g` of quadratic drag.
    pub fn response_s(&self) -> f64 {
        self.descent_m_s / self.gravity_m_s2
    }
}
