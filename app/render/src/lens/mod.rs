// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the light of a frame to its picture: motion blur, depth of field, exposure, glare and tone map.

pub(crate) mod agx;
pub(crate) mod blur_group;
pub(crate) mod exposure_pass;
pub(crate) mod focus_pass;
pub(crate) mod fullscreen;
pub(crate) mod glare_pass;
pub(crate) mod group;
pub(crate) mod metering;
pub(crate) mod motion;
pub(crate) mod post;
pub(crate) mod sample_pass;
pub(crate) mod shutter_pass;
pub(crate) mod tonemap_pass;

use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::gpu::shaders::shaders();
    let lists = [
        agx::wgsl_constants(),
        exposure_pass::wgsl_constants(),
        glare_pass::wgsl_constants(),
        metering::wgsl_constants(),
        tonemap_pass::wgsl_constants(),
    ];
    let structs = [
        group::LensUniform::declaration(),
        group::Exposure::declaration(),
        focus_pass::FocusUniform::declaration(),
        sample_pass::SampleUniform::declaration(),
        shutter_pass::ShutterUniform::declaration(),
        glare_pass::GlareScale::declaration(),
    ];
    shaders.extend([("lens/structs", declarations(lists) + &structs.concat())]);
    shaders.extend(wgsl_files!(
        "lens":
        "lens",
        "fullscreen",
        "exposure_pass",
        "focus_pass",
        "glare_pass",
        "sample_pass",
        "shutter_pass",
        "tonemap_pass"
    ));
    shaders
}

/// Shader modules with which other rooms draw the ways of what moves.
pub(crate) fn motion_shaders() -> impl Iterator<Item = (&'static str, String)> {
    let structs = ("lens/motion_structs", motion::MotionUniform::declaration());
    wgsl_files!("lens": "motion").into_iter().chain([structs])
}
