// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light in eight bands of 40 nm, and what an eye or a screen makes of it.
//!
//! Three bands are enough at noon, but not for the reds of a low sun, whose light has passed forty times as much air.

use glam::{Mat3, Vec3};

/// Number of bands.
pub(super) const BANDS: usize = 8;
/// One number for each band.
pub(super) type Spectrum = [f32; BANDS];
/// Middles of the bands in nm.
pub(super) const WAVELENGTHS_NM: Spectrum = [400.0, 440.0, 480.0, 520.0, 560.0, 600.0, 640.0, 680.0];
/// Irradiance of the sun outside the atmosphere in W/m²/nm: means over the bands of the ASTM G173-03 extraterrestrial
/// spectrum, from its means over 10 nm.
pub(super) const SUN: Spectrum = [1.404, 1.812, 1.984, 1.877, 1.843, 1.762, 1.614, 1.497];
/// Absorption cross section of ozone in 1e-25 m²: means over the bands of Serdyuchenko et al. (2014) at 233 K, from means
/// over 10 nm.
pub(super) const OZONE: Spectrum = [0.0131, 0.132, 0.634, 1.994, 3.882, 4.606, 2.964, 1.369];

/// Width of a band in nm.
const BAND_NM: f32 = 40.0;
/// Luminous efficacy in lm/W where the eye is most sensitive.
pub(super) const EFFICACY: f32 = 683.0;

/// Luminance of linear sRGB.
pub fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// From W/m²/nm in every band to linear sRGB in klx (or from W/m²/sr/nm to kcd/m²): luminance is that of Rec. 709.
#[derive(Clone, Copy, Debug)]
pub(super) struct ToRgb([Vec3; BANDS]);

impl ToRgb {
    pub(super) fn new() -> Self {
        let from_xyz = rgb_from_xyz();
        // A spectrum is taken to be linear between the middles of the bands.
        Self(WAVELENGTHS_NM.map(|middle| {
            let steps = (-40i8..=40).map(|step| f32::from(step) / 40.0);
            let xyz: Vec3 = steps.map(|at| (1.0 - at.abs()) * observer(middle + at * BAND_NM)).sum();
            from_xyz * xyz * (EFFICACY / 1000.0 * BAND_NM / 40.0)
        }))
    }

    pub(super) fn rgb(&self, spectrum: &Spectrum) -> Vec3 {
        self.0.iter().zip(spectrum).map(|(&color, &amount)| color * amount).sum()
    }
}

/// From CIE XYZ to linear sRGB: the inverse of the sRGB primaries (IEC 61966-2-1), column by column.
pub(super) fn rgb_from_xyz() -> Mat3 {
    Mat3::from_cols(
        Vec3::new(3.240_454, -0.969_266, 0.055_643),
        Vec3::new(-1.537_138, 1.876_011, -0.204_026),
        Vec3::new(-0.498_531, 0.041_556, 1.057_225),
    )
}

/// The CIE 1931 observer's response (x, y, z), as sums of lobes fitted by Wyman, Sloan and Shirley (2013).
pub(super) fn observer(nm: f32) -> Vec3 {
    let lobe = |middle: f32, below: f32, above: f32| {
        let t = (nm - middle) / if nm < middle { below } else { above };
        (-0.5 * t * t).exp()
    };
    Vec3::new(
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    )
}
