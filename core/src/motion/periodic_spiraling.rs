// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! PS: a helix, a circle seen from above.

use std::f64::consts::TAU;

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};

/// Periodic spiraling: an exact circle of radius Ae at a steady orbit rate while descending at U; the leaf keeps the
/// same side towards the axis.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicSpiraling {
    descent_m_s: f64,
    radius_m: f64,
    rate_rad_s: f64,
}

impl PeriodicSpiraling {
    /// The motion for these constants.
    pub fn new(constants: &MotionConstants) -> Self {
        Self {
            descent_m_s: constants.descent_m_s,
            radius_m: constants.spiral_radius_m,
            rate_rad_s: constants.spiral_rad_s,
        }
    }
}

impl Path for PeriodicSpiraling {
    fn period_s(&self) -> f64 {
        TAU / self.rate_rad_s
    }

    fn at(&self, time_s: f64) -> Moment {
        let (r, w) = (self.radius_m, self.rate_rad_s);
        let (sin, cos) = libm::sincos(w * time_s);
        Moment {
            position: DVec3::new(r * (cos - 1.0), -self.descent_m_s * time_s, r * sin),
            velocity: DVec3::new(-r * w * sin, -self.descent_m_s, r * w * cos),
            acceleration: DVec3::new(-r * w * w * cos, 0.0, -r * w * w * sin),
            turn: None,
        }
    }

    fn own_turns(&self) -> f64 {
        -1.0
    }
}
