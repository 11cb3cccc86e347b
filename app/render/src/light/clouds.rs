// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Effect of clouds on daylight, by measured means.

/// Daylight under a cover of clouds relative to a clear sky, and how it is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CloudShare {
    /// Illuminance of level ground, sun and sky together, relative to that under a clear sky.
    pub(super) global: f32,
    /// Share of it that comes from the sky.
    pub(super) diffuse: f32,
}

/// Ten years of hourly observations in Hamburg (Kasten and Czeplak 1980, "Solar and terrestrial radiation dependent on the
/// amount and type of cloud"): global radiation falls by three quarters under a full cover, and the sky's share of
/// it grows with the square of the cover from `clear_diffuse`.
pub(super) fn cloud_share(cover: f32, clear_diffuse: f32) -> CloudShare {
    CloudShare {
        global: 1.0 - 0.75 * cover.powf(3.4),
        diffuse: clear_diffuse + (1.0 - clear_diffuse) * cover * cover,
    }
}

/// Luminance of an overcast sky relative to that of its zenith: three times as bright there as on the horizon (Moon and
/// Spencer 1942).
pub(super) fn overcast(elevation_sin: f32) -> f32 {
    (1.0 + 2.0 * elevation_sin.max(0.0)) / 3.0
}

/// Illuminance of level ground under that sky for a zenith of one: 7 pi / 9.
pub(super) const OVERCAST_ILLUMINANCE: f32 = 7.0 / 9.0 * std::f32::consts::PI;
