// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the wind.

use super::block::NO_WATER_M;
use super::jet::core_width_m;
use super::plume::fastest_m_s;
use super::slipstream::widths_and_speeds;
use super::water::floating_surface_m;
use crate::blocks::WindBlock;
use crate::convert::single;
use crate::device::wind::gust::{GUST_ROWS, GUST_SPACING};
use crate::device::wind::profile::PROFILE_ROWS;
use crate::scene::{Profile, Scene, WindParameters};
use crate::solid::Solid;

/// Turbulence up and across the wind relative to along it (IEC 61400-1).
const DEVIATION_RATIOS: [f32; 3] = [1.0, 0.5, 0.8];
/// Height in m below which the ground keeps air from moving up and down.
const BLOCKED_M: f32 = 0.5;
/// Longest interval in seconds for which a falling leaf samples the wind: half of the time in which it responds.
const LONGEST_INTERVAL_S: f64 = 1.0 / 15.0;
/// Most steps of that interval.
pub(super) const MOST_INTERVAL_STEPS: u32 = 4;
/// Speed in m/s of a leaf through the eddies that carry it: that of its descent.
const DESCENT_M_S: f64 = 1.2;
/// Largest part of an eddy that a leaf passes through in an interval.
const LARGEST_SHARE: f64 = 0.2;

pub(super) fn wind_block(scene: &Scene, solids: &[Solid]) -> WindBlock {
    let wind = &scene.wind;
    let speed = wind.speed.metres_per_second();
    let (sin, cos) = libm::sincos(f64::from(wind.direction_deg).to_radians());
    let gust_length = speed * f64::from(wind.gusts.interval_s) / f64::from(GUST_SPACING);
    let deviation = deviation_m_s(wind);
    let interval_steps = interval_steps(scene, solids);
    // A uniform wind has no ground.
    let (least_vertical, vertical_per_m) =
        if wind.profile == Profile::Uniform { (1.0, 0.0) } else { (0.0, 1.0 / BLOCKED_M) };
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
        interval_steps,
        half_interval_s: single(0.5 * f64::from(interval_steps) * f64::from(scene.dt_s)),
        least_vertical,
        vertical_per_m,
        lowest_surface_m: floating_surface_m(scene).unwrap_or(NO_WATER_M),
        padding: Default::default(),
    }
}

/// Standard deviation of the along-wind turbulence in m/s.
pub(super) fn deviation_m_s(wind: &WindParameters) -> f32 {
    single(f64::from(wind.turbulence.intensity) * wind.speed.metres_per_second()) + wind.turbulence.calm_m_s
}

/// Steps of the interval for which a falling leaf samples the wind: the most of 4, 2 and 1 in which the wind that it
/// meets changes little.
fn interval_steps(scene: &Scene, solids: &[Solid]) -> u32 {
    let wind = &scene.wind;
    let deviation = f64::from(deviation_m_s(wind));
    let mut most_s = LONGEST_INTERVAL_S;
    if deviation > 0.0 {
        let passing = libm::hypot(deviation, DESCENT_M_S);
        most_s = most_s.min(LARGEST_SHARE * f64::from(wind.turbulence.cell_m) / passing);
    }
    for vortex in &wind.vortices {
        let core = f64::from(vortex.core_m);
        let swirl = f64::from(vortex.circulation_m2_s).abs() / (4.0 * std::f64::consts::PI * core);
        let passing = libm::hypot(swirl, f64::from(vortex.axial_m_s));
        most_s = most_s.min(LARGEST_SHARE * core / passing.max(DESCENT_M_S));
    }
    for jet in &wind.jets {
        most_s = most_s.min(LARGEST_SHARE * core_width_m(jet) / jet.fastest_m_s().max(DESCENT_M_S));
    }
    for plume in &wind.plumes {
        let width_m = f64::from(plume.base_radius_m);
        most_s = most_s.min(LARGEST_SHARE * width_m / fastest_m_s(plume).max(DESCENT_M_S));
    }
    for (width_m, speed_m_s) in widths_and_speeds(scene, solids) {
        most_s = most_s.min(LARGEST_SHARE * width_m / speed_m_s.max(DESCENT_M_S));
    }
    // Step lengths are given in single precision.
    let fits = |steps: &u32| f64::from(*steps) * f64::from(scene.dt_s) <= most_s * (1.0 + 1e-6);
    [MOST_INTERVAL_STEPS, 2].into_iter().find(fits).unwrap_or(1)
}
