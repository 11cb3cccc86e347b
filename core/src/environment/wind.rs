// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the wind.

use super::convert::{len32, single};
use crate::blocks::WindBlock;
use crate::layout::{Float4, Uint4};
use crate::scene::{Scene, WindParameters};
use crate::wind::gust::{GUST_ROWS, GUST_SPACING};
use crate::wind::profile::{PROFILE_PER_METRE, PROFILE_ROWS};

/// Turbulence up and across the wind relative to along it (IEC 61400-1).
const DEVIATION_RATIOS: [f32; 3] = [1.0, 0.5, 0.8];

pub(super) fn wind_block(scene: &Scene) -> WindBlock {
    let wind = &scene.wind;
    let speed = wind.speed.metres_per_second();
    let (sin, cos) = libm::sincos(f64::from(wind.direction_deg).to_radians());
    let gust_length = speed * f64::from(wind.gusts.interval_s) / f64::from(GUST_SPACING);
    let deviation = deviation_m_s(wind);
    let cells = DEVIATION_RATIOS.map(|ratio| 1.0 / (ratio * wind.turbulence.cell_m));
    WindBlock {
        mean: Float4([single(cos), single(sin), single(speed), PROFILE_PER_METRE]),
        gust: Float4([
            wind.gusts.strength,
            if gust_length > 0.0 { single(1.0 / gust_length) } else { 0.0 },
            scene.ground.height_m,
            0.0,
        ]),
        deviation: Float4([
            deviation * DEVIATION_RATIOS[0],
            deviation * DEVIATION_RATIOS[1],
            deviation * DEVIATION_RATIOS[2],
            0.0,
        ]),
        cells: Float4([cells[0], cells[1], cells[2], 0.0]),
        tables: Uint4([0, PROFILE_ROWS, PROFILE_ROWS + GUST_ROWS, len32(wind.vortices.len())]),
    }
}

/// Standard deviation of the along-wind turbulence in m/s.
pub(super) fn deviation_m_s(wind: &WindParameters) -> f32 {
    single(f64::from(wind.turbulence.intensity) * wind.speed.metres_per_second()) + wind.turbulence.calm_m_s
}
