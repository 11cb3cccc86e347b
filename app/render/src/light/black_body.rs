// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light of what glows with heat.

use glam::Vec3;

use super::spectrum::{EFFICACY, observer, rgb_from_xyz};

/// First radiation constant for radiance, `2 h c²`, in W m²/sr.
const FIRST_RADIATION_W_M2: f64 = 1.191_042_972e-16;
/// Second radiation constant, `h c / k`, in m K.
const SECOND_RADIATION_M_K: f64 = 1.438_776_877e-2;
/// First and last wavelength that is seen, and the steps of the sum over them, in nm.
const SEEN_NM: [u16; 3] = [380, 800, 2];

/// Radiance of a black body of a temperature in kcd/m² of linear sRGB. Most are redder than sRGB can show: the blue that is less than none
/// is left out, and luminance is kept.
///
/// # Source
/// Planck's law with the constants of CODATA 2018, seen by the CIE 1931 observer.
#[expect(clippy::cast_possible_truncation, reason = "colours are single precision")]
pub(crate) fn black_body(temperature_k: f32) -> Vec3 {
    let [first, last, step] = SEEN_NM;
    let xyz: Vec3 = (first..=last)
        .step_by(step.into())
        .map(|nm| {
            let wavelength_m = f64::from(nm) * 1e-9;
            let exponent = SECOND_RADIATION_M_K / (wavelength_m * f64::from(temperature_k));
            let per_m = FIRST_RADIATION_W_M2 / (wavelength_m.powi(5) * exponent.exp_m1());
            observer(f32::from(nm)) * (per_m * 1e-9 * f64::from(step)) as f32
        })
        .sum();
    let seen = xyz * (EFFICACY / 1000.0);
    let rgb = rgb_from_xyz() * seen;
    let shown = rgb.max(Vec3::ZERO);
    shown * (seen.y / super::luminance(shown).max(f32::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::luminance;

    /// Luminance in cd/m² by numerical integration of Planck's law with the observer's table, to two digits.
    #[test]
    fn embers_are_as_bright_as_black_bodies() {
        for (temperature_k, cd_m2) in [
            (1000.0, 2.7),
            (1100.0, 23.0),
            (1200.0, 140.0),
            (1300.0, 650.0),
            (1500.0, 7800.0),
            (1700.0, 53_000.0),
        ] {
            let found = 1000.0 * luminance(black_body(temperature_k));
            assert!((found / cd_m2 - 1.0f32).abs() < 0.05, "{temperature_k} K: {found}, not {cd_m2} cd/m²");
        }
    }

    #[test]
    fn embers_are_red_flames_yellow_and_the_sun_white() {
        let share = |temperature_k: f32| black_body(temperature_k) / black_body(temperature_k).x;
        let [ember, flame, lamp] = [1000.0, 1800.0, 2800.0].map(share);
        assert!(ember.y < 0.12 && ember.z == 0.0, "an ember: {ember}");
        assert!((0.2..0.4).contains(&flame.y) && flame.z < 0.02, "a flame: {flame}");
        assert!(lamp.y > flame.y && lamp.z > flame.z, "a lamp: {lamp}");
    }
}
