// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Composition of the air: molecules, aerosol and ozone over a round Earth. Lengths are in km.

use super::spectrum::{BANDS, OZONE, Spectrum, WAVELENGTHS_NM};
use super::table::single;

/// Radius of the Earth.
pub(super) const EARTH_KM: f64 = 6371.0;
/// Radius at which the air ends.
pub(super) const TOP_KM: f64 = EARTH_KM + 80.0;

/// Rayleigh scattering at sea level at 1 µm, 1/km; it goes with the fourth power of the wave number (Penndorf 1957).
const RAYLEIGH_PER_KM: f32 = 1.24e-3;
/// Heights in which molecules and aerosol thin to 1/e.
const RAYLEIGH_HEIGHT_KM: f64 = 8.0;
const AEROSOL_HEIGHT_KM: f64 = 1.2;
/// Decrease of aerosol extinction with wavelength: Ångström's exponent of continental air.
const ANGSTROM_EXPONENT: f32 = 1.3;
/// Share of what aerosol takes out of a ray that it scatters.
const AEROSOL_ALBEDO: f32 = 0.93;
/// Asymmetry of aerosol scattering.
const AEROSOL_ASYMMETRY: f64 = 0.76;
/// Ozone above a square metre in molecules: 300 Dobson units.
const OZONE_PER_M2: f32 = 300.0 * 2.687e20;

/// Amounts met along a path, in km of sea-level air for molecules and aerosol, and of the densest layer for ozone.
pub(super) type Columns = [f64; 3];

/// The scattering and absorption of clear air.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Atmosphere {
    /// Scattering by molecules at sea level, 1/km.
    pub(super) rayleigh: Spectrum,
    /// Extinction by aerosol at sea level, 1/km.
    pub(super) aerosol: Spectrum,
    /// Absorption by ozone where it is densest, 1/km.
    pub(super) ozone: Spectrum,
}

impl Atmosphere {
    /// Air with an aerosol of this vertical optical depth at 550 nm.
    pub(crate) fn new(aerosol: f32) -> Self {
        let rayleigh = WAVELENGTHS_NM.map(|nm| RAYLEIGH_PER_KM * (nm / 1000.0).powi(-4));
        let at_550 = aerosol / single(AEROSOL_HEIGHT_KM);
        let aerosol = WAVELENGTHS_NM.map(|nm| at_550 * (nm / 550.0).powf(-ANGSTROM_EXPONENT));
        // The layer is a triangle 30 km wide, so its densest part holds a fifteenth of it in each km.
        let ozone = OZONE.map(|cross_section| cross_section * 1e-25 * OZONE_PER_M2 / 15.0);
        Self { rayleigh, aerosol, ozone }
    }

    /// Extinction of a path that met `columns`.
    pub(super) fn depth(&self, columns: Columns) -> Spectrum {
        let [molecules, aerosol, ozone] = columns.map(single);
        std::array::from_fn(|band| {
            self.rayleigh[band] * molecules + self.aerosol[band] * aerosol + self.ozone[band] * ozone
        })
    }

    /// Scattering at a density: by molecules and by aerosol.
    pub(super) fn scattering(&self, [molecules, aerosol, _]: Columns) -> [Spectrum; 2] {
        let scaled = |spectrum: &Spectrum, by: f32| spectrum.map(|value| value * by);
        [scaled(&self.rayleigh, single(molecules)), scaled(&self.aerosol, single(aerosol) * AEROSOL_ALBEDO)]
    }
}

/// Densities at a height relative to those that the coefficients are for.
pub(super) fn densities(height_km: f64) -> Columns {
    [
        (-height_km / RAYLEIGH_HEIGHT_KM).exp(),
        (-height_km / AEROSOL_HEIGHT_KM).exp(),
        (1.0 - (height_km - 25.0).abs() / 15.0).max(0.0),
    ]
}

/// Light that passes a depth.
pub(super) fn transmitted(depth: &Spectrum) -> Spectrum {
    std::array::from_fn::<f32, BANDS, _>(|band| (-depth[band]).exp())
}

/// Share of light that molecules scatter by an angle, per steradian.
pub(super) fn rayleigh_phase(cos: f64) -> f32 {
    single(3.0 / (16.0 * std::f64::consts::PI) * (1.0 + cos * cos))
}

/// Share of light that aerosol scatters by an angle, per steradian (Cornette and Shanks 1992).
pub(super) fn aerosol_phase(cos: f64) -> f32 {
    let g = AEROSOL_ASYMMETRY;
    let scale = 3.0 / (8.0 * std::f64::consts::PI) * (1.0 - g * g) / (2.0 + g * g);
    single(scale * (1.0 + cos * cos) / (1.0 + g * g - 2.0 * g * cos).powf(1.5))
}
