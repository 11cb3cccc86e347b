// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reference models of flight in double precision: two published planar models of falling plates, and the disc in
//! three dimensions. The planar ones are not for leaves: neither knows a third dimension or a finite span.

mod leaf_disc;
mod plate;
mod sectional;

pub use leaf_disc::{DiscCoefficients, DiscState, LeafDisc};
pub use plate::FallingPlate;
pub use sectional::SectionalPlate;

/// State of a planar plate, or its rate of change: velocity along the chord, velocity along the normal, turning rate,
/// pitch from horizontal, place across, height. The normal is the chord turned by a quarter turn anticlockwise.
pub type PlateState = [f64; 6];

/// Velocities turned from the plate's axes to across and up.
fn world_velocity(along: f64, normal: f64, pitch: f64) -> (f64, f64) {
    let (sin, cos) = libm::sincos(pitch);
    (along * cos - normal * sin, along * sin + normal * cos)
}
