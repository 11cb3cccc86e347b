// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground, grass, water and sky.

pub(crate) mod grass_pass;
pub(crate) mod ground_pass;
pub(crate) mod sky_pass;
pub(crate) mod snow_map;
pub(crate) mod snow_pass;
mod terrain_mesh;
pub(crate) mod water_pass;

use windfall_core::device::terrain::snow;
use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    let water = snow::wgsl_constants().into_iter().filter(|(name, _)| *name == "FLOOR_ON_WATER").collect();
    let lists = [grass_pass::wgsl_constants(), terrain_mesh::wgsl_constants(), water];
    shaders.extend([(
        "scenery/structs",
        declarations(lists) + &grass_pass::GrassCell::declaration() + &snow_pass::SnowUniform::declaration(),
    )]);
    shaders.extend(wgsl_files!(
        "scenery": "meadow", "horizon", "grass_pass", "ground_pass", "sky_pass", "snow_pass", "water_pass", "snow_map"
    ));
    shaders
}
