// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! PT: end over end, drifting to one side.

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};
use super::swing_segment::SwingSegment;

/// Periodic tumbling: swings that all go the same way, so that `vx = Ax |cos W t|`; mean drift `2 Ax / pi`, half a
/// turn each swing, a whole turn each period.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicTumbling {
    swing: SwingSegment,
}

impl PeriodicTumbling {
    /// The motion for these constants.
    pub fn new(constants: &MotionConstants) -> Self {
        Self {
            swing: SwingSegment {
                descent_m_s: constants.descent_m_s,
                horizontal_m_s: constants.horizontal_m_s,
                vertical_m_s: constants.vertical_m_s,
                rate_rad_s: constants.tumble_rad_s,
                direction: 1.0,
                wobble: constants.tumble_wobble,
            },
        }
    }
}

impl Path for PeriodicTumbling {
    fn period_s(&self) -> f64 {
        2.0 * self.swing.duration_s()
    }

    fn at(&self, time_s: f64) -> Moment {
        let duration = self.swing.duration_s();
        let swings = libm::floor(time_s / duration);
        let mut moment = self.swing.at(time_s - swings * duration);
        let advance = 2.0 * self.swing.horizontal_m_s / self.swing.rate_rad_s;
        moment.position += swings * DVec3::new(advance, -self.swing.descent_m_s * duration, 0.0);
        moment.turn = moment.turn.map(|turn| turn + swings * std::f64::consts::PI);
        moment
    }
}
