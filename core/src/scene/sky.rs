// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sky that lights a scene, and the air in it. Nothing here changes the simulation.

use serde::{Deserialize, Serialize};

/// Source of the sky's light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Sky {
    /// Computed from air, aerosol, clouds and the place of the sun.
    Physical(PhysicalSky),
    /// Read from a picture of high dynamic range.
    Map(SkyMap),
}

impl Default for Sky {
    fn default() -> Self {
        Self::Physical(PhysicalSky::default())
    }
}

/// A day's air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhysicalSky {
    /// Vertical optical depth of the aerosol at 550 nm, 0 to 1: 0.05 is very clear air, 0.1 clear, 0.4 hazy.
    pub aerosol: f32,
    /// Share of the sky that clouds cover, 0 to 1: 0.2 is fair, 1 overcast without any direct sun.
    pub cloud_cover: f32,
}

impl Default for PhysicalSky {
    fn default() -> Self {
        Self { aerosol: 0.12, cloud_cover: 0.3 }
    }
}

/// A picture of a whole sky.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkyMap {
    /// A Radiance file (`.hdr`) or an OpenEXR file (`.exr`): latitude and longitude (2:1), or a cube laid out as a cross
    /// (3:4 or 4:3). A path in a scene file is relative to the file's folder.
    pub path: String,
    /// Turn about the vertical in degrees, -360 to 360, from +x to +z. At 0 the middle of a 2:1 picture is seen towards -z.
    pub rotation_deg: f32,
    /// Luminance of the picture's value 1 in kcd/m², 0.001 to 1000. Pictures are rarely calibrated.
    pub intensity_kcd_m2: f32,
}

impl Default for SkyMap {
    /// No file yet, which is not allowed; value 1 about as bright as a clear sky.
    fn default() -> Self {
        Self { path: String::new(), rotation_deg: 0.0, intensity_kcd_m2: 5.0 }
    }
}

impl SkyMap {
    /// A picture as it is.
    pub fn new(path: String) -> Self {
        Self { path, ..Self::default() }
    }
}

/// Mist near the ground, which fades what lies far away.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Haze {
    /// Meteorological visibility on the ground in metres, 20 to 100000: where black things fade to a contrast of 2 %.
    pub visibility_m: f32,
    /// Height above the ground in metres, 1 to 10000, at which the haze has thinned to 1/e.
    pub depth_m: f32,
}

impl Default for Haze {
    fn default() -> Self {
        Self { visibility_m: 1200.0, depth_m: 60.0 }
    }
}
