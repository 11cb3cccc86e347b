// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Absorption of leaf pigments as a few bands each.
//!
//! The bands are our own fit (Levenberg and Marquardt) to the specific absorption coefficients of PROSPECT-D (Féret,
//! Gitelson, Noble and Jacquemoud 2017) from 400 to 780 nm; the root mean square error is 0.5 % (carotenoids) to
//! 1.0 % (anthocyanin) of the largest coefficient; small coefficients weigh more, since they make the light colours. A band whose centre
//! lies outside that range is the tail of something stronger there.

/// A Gaussian band.
struct Band {
    /// Height in the pigment's unit.
    height: f64,
    /// Centre in nm.
    centre_nm: f64,
    /// Standard deviation in nm.
    width_nm: f64,
}

const fn band(height: f64, centre_nm: f64, width_nm: f64) -> Band {
    Band { height, centre_nm, width_nm }
}

/// Chlorophyll a and b in cm²/µg; the negative band cuts the valley in the green.
const CHLOROPHYLL: [Band; 7] = [
    band(0.061_114, 406.4, 18.9),
    band(0.032_5, 439.4, 10.6),
    band(0.039_677, 470.7, 38.5),
    band(-0.015_591, 515.0, 17.7),
    band(0.023_964, 620.7, 44.1),
    band(0.037_648, 677.4, 8.7),
    band(0.027_861, 667.0, 19.2),
];
/// Carotenoids in cm²/µg.
const CAROTENOID: [Band; 4] = [
    band(0.156_33, 391.5, 32.1),
    band(0.130_96, 450.9, 25.0),
    band(0.083_533, 494.9, 18.4),
    band(0.019_961, 527.0, 11.8),
];
/// Anthocyanin in cm²/µg.
const ANTHOCYANIN: [Band; 4] = [
    band(6.537, 222.5, 56.0),
    band(0.042_004, 461.4, 55.1),
    band(0.056_917, 540.0, 38.6),
    band(0.001_365_7, 639.5, 20.8),
];
/// Brown pigment, a unit of its own.
const BROWN: [Band; 2] = [band(9.698_5, -753.7, 437.0), band(0.262_9, 479.2, 147.3)];

/// Specific absorption at one wavelength.
#[derive(Clone, Copy, Debug)]
pub(super) struct Absorption {
    /// cm²/µg.
    pub(super) chlorophyll: f64,
    /// cm²/µg.
    pub(super) carotenoid: f64,
    /// cm²/µg.
    pub(super) anthocyanin: f64,
    /// 1/unit.
    pub(super) brown: f64,
    /// cm²/g.
    pub(super) dry_matter: f64,
}

fn sum(bands: &[Band], wavelength_nm: f64) -> f64 {
    let shape = |b: &Band| {
        let z = (wavelength_nm - b.centre_nm) / b.width_nm;
        b.height * libm::exp(-0.5 * z * z)
    };
    bands.iter().map(shape).sum::<f64>().max(0.0)
}

/// Absorption at a wavelength from 400 to 780 nm. That of water (below 0.0003 for a leaf) is left out.
pub(super) fn at(wavelength_nm: f64) -> Absorption {
    Absorption {
        chlorophyll: sum(&CHLOROPHYLL, wavelength_nm),
        carotenoid: sum(&CAROTENOID, wavelength_nm),
        anthocyanin: sum(&ANTHOCYANIN, wavelength_nm),
        brown: sum(&BROWN, wavelength_nm),
        dry_matter: 2.3 + 107.4 * libm::exp(-(wavelength_nm - 400.0) / 16.3),
    }
}

/// Refractive index at a wavelength from 400 to 780 nm, within 0.006 of the same source.
pub(super) fn refractive_index(wavelength_nm: f64) -> f64 {
    let x = (wavelength_nm - 590.0) / 190.0;
    1.461_96 + x * (-0.046 + x * (0.011_02 + x * 0.009_8))
}
