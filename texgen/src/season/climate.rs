// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Days of an autumn: how warm, how long.

use std::f64::consts::{PI, TAU};

/// A mean year at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Climate {
    /// Latitude in degrees north, -66 to 66.
    pub latitude_deg: f64,
    /// Mean temperature of the year in °C.
    pub mean_c: f64,
    /// Half the difference between the warmest and the coldest day in °C.
    pub swing_c: f64,
    /// Share of the daylight that comes through the clouds, 0 to 1.
    pub sunshine: f64,
}

impl Default for Climate {
    /// Central Europe: 50° north, 9.5 ± 9.5 °C, autumns with some sun.
    fn default() -> Self {
        Self { latitude_deg: 50.0, mean_c: 9.5, swing_c: 9.5, sunshine: 0.6 }
    }
}

impl Climate {
    /// Mean temperature of a day of the year (1 to 365) in °C; late July is warmest.
    pub fn temperature_c(&self, day: f64) -> f64 {
        self.mean_c + self.swing_c * libm::cos(TAU * (day - 203.0) / 365.0)
    }

    /// Hours from sunrise to sunset (sun's declination after Cooper 1969).
    pub fn day_length_h(&self, day: f64) -> f64 {
        let declination = 23.45_f64.to_radians() * libm::sin(TAU * (284.0 + day) / 365.0);
        let latitude = self.latitude_deg.clamp(-66.0, 66.0).to_radians();
        let x = -libm::tan(latitude) * libm::tan(declination);
        24.0 / PI * libm::acos(x.clamp(-1.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_shorten_and_cool_through_autumn() {
        let climate = Climate::default();
        let equinox = climate.day_length_h(266.0);
        assert!((equinox - 12.0).abs() < 0.2, "day and night are equal in late September, got {equinox} h");
        assert!((climate.day_length_h(172.0) - 16.1).abs() < 0.4, "midsummer at 50° has 16 h");
        assert!(climate.temperature_c(244.0) > climate.temperature_c(320.0) + 8.0, "November is colder");
    }
}
