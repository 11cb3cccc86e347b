// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! TH: swings whose plane turns, a rose seen from above.

use std::f64::consts::TAU;

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};

/// An elliptical oscillation in a frame that precesses once for every `k` swings:
/// ```text
/// X = Ae [cos(k W t) cos(W t) - Ee sin(k W t) sin(W t)]
/// Z = Ae [cos(k W t) sin(W t) + Ee sin(k W t) cos(W t)]
/// ```
/// With `Ee = 0` the radius is `Ae |cos(k phi)|`: for k = 4 a rose of exactly eight petals; with `Ee = 1` a circle.
/// The forms that the thesis and the paper print give four petals, a cardioid or a circle.
#[derive(Clone, Copy, Debug)]
pub struct TransitionalHelical {
    descent_m_s: f64,
    radius_m: f64,
    ellipticity: f64,
    swings: f64,
    /// Rate of precession W.
    rate_rad_s: f64,
}

impl TransitionalHelical {
    /// The motion for these constants: its swings keep the rate of fluttering.
    pub fn new(constants: &MotionConstants) -> Self {
        Self {
            descent_m_s: constants.descent_m_s,
            radius_m: constants.rose_radius_m,
            ellipticity: constants.rose_ellipticity,
            swings: f64::from(constants.rose_swings),
            rate_rad_s: constants.flutter_rad_s / f64::from(constants.rose_swings),
        }
    }

    /// The rose itself: horizontal position, velocity and acceleration, from its centre.
    fn rose(&self, time_s: f64) -> [DVec3; 3] {
        // Both products of sines and cosines are sums of two uniform circular motions, of rates k + 1 and k - 1.
        let circle = |radius: f64, rate: f64| {
            let (sin, cos) = libm::sincos(rate * time_s);
            [
                DVec3::new(cos, 0.0, sin) * radius,
                DVec3::new(-sin, 0.0, cos) * (radius * rate),
                DVec3::new(-cos, 0.0, -sin) * (radius * rate * rate),
            ]
        };
        let fast =
            circle(0.5 * self.radius_m * (1.0 + self.ellipticity), (self.swings + 1.0) * self.rate_rad_s);
        let slow =
            circle(0.5 * self.radius_m * (1.0 - self.ellipticity), (1.0 - self.swings) * self.rate_rad_s);
        [fast[0] + slow[0], fast[1] + slow[1], fast[2] + slow[2]]
    }
}

impl Path for TransitionalHelical {
    fn period_s(&self) -> f64 {
        TAU / self.rate_rad_s
    }

    fn at(&self, time_s: f64) -> Moment {
        let [position, velocity, acceleration] = self.rose(time_s);
        let start = self.rose(0.0)[0];
        Moment {
            position: position - start - DVec3::Y * (self.descent_m_s * time_s),
            velocity: velocity - DVec3::Y * self.descent_m_s,
            acceleration,
            turn: None,
        }
    }
}
