// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sun as a directional light.

use glam::Vec3;
use windfall_core::scene::Sun;

/// A directional light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunLight {
    /// Direction towards it.
    pub direction: Vec3,
    /// Illuminance in klx of a surface that faces it.
    pub illuminance: Vec3,
}

/// Unit vector towards the sun.
pub(super) fn sun_direction(sun: &Sun) -> Vec3 {
    let (elevation_sin, elevation_cos) = sun.elevation_deg.to_radians().sin_cos();
    let (azimuth_sin, azimuth_cos) = sun.azimuth_deg.to_radians().sin_cos();
    Vec3::new(elevation_cos * azimuth_cos, elevation_sin, elevation_cos * azimuth_sin)
}
