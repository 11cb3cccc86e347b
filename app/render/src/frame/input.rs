// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What changes from frame to frame besides the leaves.

use crate::camera::Camera;

/// What changes from frame to frame besides the leaves.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput {
    /// The camera.
    pub camera: Camera,
    /// Time of the simulation in seconds: moves clouds and grass, and ages trails.
    pub time_s: f64,
    /// Seconds since the frame before, for the lens to adapt to brightness; infinite adapts at once.
    pub since_s: f32,
    /// Where in the output the picture's upper left corner lies, in pixels; the picture must lie inside the output.
    pub origin: (u32, u32),
}
