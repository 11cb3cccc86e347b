// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the wind.

use crate::blocks::WindBlock;
use crate::convert::single;
use crate::device::wind::gust::{GUST_ROWS, GUST_SPACING};
use crate::device::wind::profile::PROFILE_ROWS;
use crate::scene::{Scene, WindParameters};

/// Turbulence up and across the wind relative to along it (IEC 61400-1).
const DEVIATION_RATIOS: [f32; 3] = [1.0, 0.5, 0.8];

pub(super) fn wind_block(scene: &Scene) -> WindBlock {
    let wind = &scene.wind;
    let speed = wind.speed.metres_per_second();
    let (sin, cos) = libm::sincos(f64::from(wind.direction_deg).to_radians());
    let gust_length = speed * f64::from(wind.gusts.interval_s) / f64::from(GUST_SPACING);
    let deviation = deviation_m_s(wind);
    WindBlock {
        direction_x: single(cos),
        direction_z: single(sin),
        mean_speed_m_s: single(speed),
        gust_strength: wind.gusts.strength,
        deviation_m_s: DEVIATION_RATIOS.map(|ratio| deviation * ratio),
        gust_rows_per_m: if gust_length > 0.0 { single(1.0 / gust_length) } else { 0.0 },
        cells_per_m: DEVIATION_RATIOS.map(|ratio| 1.0 / (ratio * wind.turbulence.cell_m)),
        first_profile_row: 0,
        first_gust_row: PROFILE_ROWS,
        first_turbulence_row: PROFILE_ROWS + GUST_ROWS,
        padding: Default::default(),
    }
}

/// Standard deviation of the along-wind turbulence in m/s.
pub(super) fn deviation_m_s(wind: &WindParameters) -> f32 {
    single(f64::from(wind.turbulence.intensity) * wind.speed.metres_per_second()) + wind.turbulence.calm_m_s
}
