// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One swing from turning point to turning point, the piece that tumbling and chaotic motion are made of.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::path::Moment;

/// A swing: `vx = s Ax cos f`, `vy = -U + Ay sin 2f` for f from -pi/2 to pi/2. At both ends the velocity is (0, -U),
/// so swings of any amplitude, rate and direction follow one another without a jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct SwingSegment {
    pub(super) descent_m_s: f64,
    pub(super) horizontal_m_s: f64,
    pub(super) vertical_m_s: f64,
    pub(super) rate_rad_s: f64,
    /// +1 or -1: towards which side of x.
    pub(super) direction: f64,
    /// Unevenness e of the rotation `f + e sin 2f`.
    pub(super) wobble: f64,
}

impl SwingSegment {
    pub(super) fn duration_s(&self) -> f64 {
        PI / self.rate_rad_s
    }

    /// The moment `time_s` after the swing's start, from the origin. The leaf turns by pi about +z times the
    /// direction: the sense in which the circulation of the turning leaf pushes it the way it drifts.
    pub(super) fn at(&self, time_s: f64) -> Moment {
        let (ax, ay, w, s) = (self.horizontal_m_s, self.vertical_m_s, self.rate_rad_s, self.direction);
        let f = w * time_s - FRAC_PI_2;
        let (sin_f, cos_f) = libm::sincos(f);
        let (sin_2f, cos_2f) = libm::sincos(2.0 * f);
        Moment {
            position: DVec3::new(
                s * ax / w * (sin_f + 1.0),
                -self.descent_m_s * time_s - ay / (2.0 * w) * (cos_2f + 1.0),
                0.0,
            ),
            velocity: DVec3::new(s * ax * cos_f, -self.descent_m_s + ay * sin_2f, 0.0),
            acceleration: DVec3::new(-s * ax * w * sin_f, 2.0 * ay * w * cos_2f, 0.0),
            turn: Some(s * (f + FRAC_PI_2 + self.wobble * sin_2f)),
        }
    }
}
