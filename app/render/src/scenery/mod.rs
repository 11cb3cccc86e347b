// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground, grass, water and sky.

pub(crate) mod grass_pass;
pub(crate) mod ground_pass;
pub(crate) mod sky_pass;
mod snow_caps;
mod snow_cells;
pub(crate) mod snow_map;
pub(crate) mod snow_pass;
mod terrain_mesh;
pub(crate) mod water_pass;

use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    let lists = [grass_pass::wgsl_constants(), terrain_mesh::wgsl_constants()];
    shaders.extend([(
        "scenery/structs",
        declarations(lists)
            + &grass_pass::GrassCell::declaration()
            + &grass_pass::GrassClass::declaration()
            + &grass_pass::GrassBlade::declaration()
            + &snow_pass::SnowUniform::declaration()
            + &snow_caps::CapNode::declaration()
            + &snow_cells::DrawnCell::declaration(),
    )]);
    shaders.extend(wgsl_files!(
        "scenery": "meadow", "horizon", "grass_light", "grass_pass", "ground_pass", "sky_pass", "snow_pass", "water_pass", "snow_map"
    ));
    shaders
}
