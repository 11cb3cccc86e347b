// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Growers of veins, all behind [`VeinGrower`](crate::VeinGrower).
//!
//! - [`ContourGuided`]: main, lateral and tertiary veins led by lobes and teeth of the margin (Kim and Kim 2017);
//! - [`Runions`]: open or closed venation towards auxin (Runions et al. 2005);
//! - [`ParticleFlow`]: traces of particles on their way to the root (Rodkaew et al. 2002);
//! - [`SpeciesVeins`]: the first for the strong veins, the second for the fine ones; what leaves are made with.
//!
//! All share a draft that refuses segments which would cross another or leave the blade, so graphs are planar by
//! construction. Every length is a share of √A, A being the blade's area: a larger picture has the same veins.

mod contour_guided;
mod curve;
mod draft;
mod fan;
mod flow;
mod ground;
mod habit;
mod laterals;
mod margin;
mod particle_flow;
mod route;
mod runions;
mod species_veins;
mod tertiary;
#[cfg(test)]
mod tests;

pub use contour_guided::ContourGuided;
pub use curve::Curve;
pub use habit::{Habit, LateralTargets, Layout};
pub use particle_flow::ParticleFlow;
pub use runions::Runions;
pub use species_veins::SpeciesVeins;

use crate::TexgenError;

/// Distance between neighbouring nodes as a share of √A.
pub(crate) const STEP: f32 = 0.006;

/// The error of a blade that leaves no room for any vein.
fn no_vein<T>() -> Result<T, TexgenError> {
    Err(TexgenError::NoRoom { reason: "no step away from the root stays inside the blade".into() })
}
