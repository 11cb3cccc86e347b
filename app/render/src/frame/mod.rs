// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind groups 0 and 1, which all passes of a scene share: camera, sun and air of a frame, the land, shadow maps and the sky.

pub(crate) mod cascades;
pub(crate) mod fire_light;
pub(crate) mod group;
pub(crate) mod input;
pub(crate) mod lens_moment;
pub(crate) mod light_group;
pub(crate) mod noise;
pub(crate) mod scene_pipeline;
pub(crate) mod sides;
pub(crate) mod sky_texture;
pub(crate) mod sunlit_air;
pub(crate) mod surroundings;

use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};
use crate::land::texture::LandUniform;
use crate::light;

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::gpu::shaders::shaders();
    let lists = [
        cascades::wgsl_constants(),
        fire_light::wgsl_constants(),
        sunlit_air::wgsl_constants(),
        surroundings::wgsl_constants(),
        light::wgsl_constants(),
    ];
    let structs = surroundings::FrameUniform::declaration()
        + &LandUniform::declaration()
        + &fire_light::FireLight::declaration();
    shaders.extend([("frame/structs", declarations(lists) + &structs)]);
    shaders.extend(wgsl_files!("frame": "common", "coverage", "fire_light", "light"));
    shaders
}
