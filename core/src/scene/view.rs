// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! View of a scene. Nothing here changes the simulation.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{CameraKey, Haze, Lens, Sky};

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Camera {
    /// Position in metres, each component -100000 to 100000.
    pub eye_m: Vec3,
    /// Point looked at in metres, each component -100000 to 100000, at least 0.01 m from the position.
    pub target_m: Vec3,
    /// Vertical field of view in degrees, 5 to 120.
    pub vertical_fov_deg: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { eye_m: Vec3::new(0.0, 1.6, 9.0), target_m: Vec3::new(0.0, 2.6, 0.0), vertical_fov_deg: 50.0 }
    }
}

/// The sun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sun {
    /// Direction it is seen in, degrees from +x turning to +z, -360 to 360.
    pub azimuth_deg: f32,
    /// Height above the horizon in degrees, -6 to 90. Below the horizon it lights the sky alone.
    pub elevation_deg: f32,
}

impl Default for Sun {
    fn default() -> Self {
        Self { azimuth_deg: -60.0, elevation_deg: 38.0 }
    }
}

/// View of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// Keys that the camera follows instead, at most 1024. The park is laid out around what `camera` sees all the same.
    pub path: Vec<CameraKey>,
    /// The lens.
    pub lens: Lens,
    /// The sun.
    pub sun: Sun,
    /// Sun beside the sky; a picture of the sky brings its own.
    pub sky: Sky,
    /// Haze between the eye and what it sees.
    pub haze: Haze,
    /// Length of the trail drawn behind every leaf in seconds, 0 to 30: none at 0. Trails are drawn for the first
    /// 4096 leaves.
    pub trail_s: f32,
}
