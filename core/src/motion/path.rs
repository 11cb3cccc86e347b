// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The path of a primitive motion: position, velocity and forces at a time.

use glam::DVec3;

/// A moment on a primitive path, relative to the moving air. The plane of planar motions is x-y; y is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Position in metres; the origin at time zero.
    pub position: DVec3,
    /// Velocity in m/s.
    pub velocity: DVec3,
    /// Acceleration in m/s².
    pub acceleration: DVec3,
    /// Explicit rotation about +z in radians, for motions that turn over.
    pub turn: Option<f64>,
}

/// A primitive motion: a path that repeats, but for a constant displacement, after one period.
pub trait Path {
    /// Length of one period in seconds.
    fn period_s(&self) -> f64;

    /// The moment at `time_s` seconds from the start, for any time from zero on.
    fn at(&self, time_s: f64) -> Moment;

    /// Turns about the leaf's own normal within one period beyond those that close the orientation.
    fn own_turns(&self) -> f64 {
        0.0
    }
}
