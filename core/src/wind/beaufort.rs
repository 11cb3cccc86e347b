// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The Beaufort scale.

use crate::scene::MeanSpeed;

/// Largest Beaufort number.
pub const BEAUFORT_MAX: u8 = 12;

/// Mean speed at 10 m in m/s for a Beaufort number: `0.836 B^1.5`.
pub fn beaufort_speed(number: u8) -> f64 {
    let b = f64::from(number);
    0.836 * b * libm::sqrt(b)
}

impl MeanSpeed {
    /// The speed in m/s.
    pub fn metres_per_second(self) -> f64 {
        match self {
            Self::MetresPerSecond(speed) => f64::from(speed),
            Self::Beaufort(number) => beaufort_speed(number),
        }
    }
}
