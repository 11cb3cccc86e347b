// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves painted by what they do, for looking at the motion rather than at autumn.
//!
//! While nothing is painted none of this exists: the shaders of leaves are compiled without it.

pub(crate) mod landing_count;
pub(crate) mod landing_pass;
mod overlay;
pub(crate) mod paint_pass;
pub(crate) mod palette;
mod particle_paint;
mod shelter_map;
pub(crate) mod shelter_pass;
pub(crate) mod trail_pass;

use windfall_core::layout::WgslStruct;
use windfall_core::shared_constants;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

pub use landing_count::LANDINGS_PER_M2;
pub use palette::{ATTACHED, MOTIONS, RESTING, population_bytes, shade_bytes};
pub use particle_paint::{ParticleMeasure, ParticlePaint};
pub use shelter_map::ShelterMap;
pub use trail_pass::MAX_TRAILS;

/// Property that colours show.
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
    /// Speed in m/s of the wind at its edge that takes a leaf from the litter, if none covers it.
    Wake,
    /// Metres that a lying leaf lies above the ground: the depth of the litter under it.
    Depth,
    /// Share of the mean wind that is left at a lying leaf, by the [`ShelterMap`] that the renderer has been given.
    Shelter,
}

/// Paint of the leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// Property that colours show.
    pub measure: Measure,
    /// The amount at the light end of the colours, above zero; for motions nothing.
    pub most: f32,
}

shared_constants! {
    /// Leaves that a workgroup handles.
    pub(crate) const MARKS_GROUP_SIZE: u32 = 64;
}

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    let lists = [
        wgsl_constants(),
        palette::wgsl_constants(),
        paint_pass::wgsl_constants(),
        trail_pass::wgsl_constants(),
    ];
    let structs = [
        landing_count::LandingUniform::declaration(),
        paint_pass::PaintUniform::declaration(),
        paint_pass::PastMark::declaration(),
        shelter_pass::ShelterUniform::declaration(),
        trail_pass::TrailUniform::declaration(),
        trail_pass::TrailSample::declaration(),
    ];
    shaders.extend([("marks/structs", declarations(lists) + &structs.concat())]);
    shaders.extend(wgsl_files!(
        "marks": "landing_count", "landing_pass", "paint_pass", "shelter_pass", "trail_pass", "trail_sample"
    ));
    shaders
}
