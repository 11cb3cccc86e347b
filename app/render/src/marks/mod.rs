// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves painted by what they do, for looking at the motion rather than at autumn.
//!
//! While nothing is painted none of this exists: the shaders of leaves are compiled without it.

pub(crate) mod landing_count;
pub(crate) mod landing_pass;
pub(crate) mod paint_pass;
mod palette;
pub(crate) mod trail_pass;

pub use landing_count::LANDINGS_PER_M2;
pub use palette::{ATTACHED, MOTIONS, RESTING, shade_bytes};
pub use trail_pass::MAX_TRAILS;

/// What colours tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Which motion or regime a falling leaf is in.
    Motion,
    /// Speed over the last frame in m/s.
    Speed,
    /// Seconds since its release.
    Age,
    /// Metres above the ground at the origin.
    Height,
}

/// How leaves are painted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// What colours tell.
    pub measure: Measure,
    /// The amount at the light end of the colours, above zero; for motions nothing.
    pub most: f32,
}
