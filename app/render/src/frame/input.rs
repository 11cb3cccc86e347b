// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Inputs of a frame besides the leaves.

use super::lens_moment::LensMoment;
use crate::camera::Camera;

/// Inputs of a frame besides the leaves.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput {
    /// The camera.
    pub camera: Camera,
    /// Time of the simulation in seconds: moves clouds and grass, and ages trails.
    pub time_s: f64,
    /// Moment for the lens, which adapts to brightness.
    pub moment: LensMoment,
    /// Place of the picture's upper left corner in the output, in pixels; the picture must lie inside the output.
    pub origin: (u32, u32),
}
