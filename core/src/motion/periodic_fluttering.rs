// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! PF: swinging from side to side.

use std::f64::consts::TAU;

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};

/// Periodic fluttering (Andersen, Pesavento and Wang 2005):
/// `vx = -Ax cos(W t)`, `vy = -U + Ay sin(2 W t)`. Mean descent is exactly U, and at every turning point the
/// velocity is (0, -U) whatever the amplitudes are.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicFluttering {
    descent_m_s: f64,
    horizontal_m_s: f64,
    vertical_m_s: f64,
    rate_rad_s: f64,
}

impl PeriodicFluttering {
    /// The motion for these constants.
    pub fn new(constants: &MotionConstants) -> Self {
        Self {
            descent_m_s: constants.descent_m_s,
            horizontal_m_s: constants.horizontal_m_s,
            vertical_m_s: constants.vertical_m_s,
            rate_rad_s: constants.flutter_rad_s,
        }
    }
}

impl Path for PeriodicFluttering {
    fn period_s(&self) -> f64 {
        TAU / self.rate_rad_s
    }

    fn at(&self, time_s: f64) -> Moment {
        let (ax, ay, w) = (self.horizontal_m_s, self.vertical_m_s, self.rate_rad_s);
        let f = w * time_s;
        let (sin_f, cos_f) = libm::sincos(f);
        let (sin_2f, cos_2f) = libm::sincos(2.0 * f);
        Moment {
            position: DVec3::new(
                -ax / w * sin_f,
                -self.descent_m_s * time_s - ay / (2.0 * w) * (cos_2f - 1.0),
                0.0,
            ),
            velocity: DVec3::new(-ax * cos_f, -self.descent_m_s + ay * sin_2f, 0.0),
            acceleration: DVec3::new(ax * w * sin_f, 2.0 * ay * w * cos_2f, 0.0),
            turn: None,
        }
    }
}
