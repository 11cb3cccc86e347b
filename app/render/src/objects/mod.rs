// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The objects of a scene and those who walk there, as they are drawn: a mesh for each kind of shape, and a record for each part.

mod body;
pub mod meshes;
pub(crate) mod motion_pass;
pub(crate) mod object_pass;
pub(crate) mod records;
pub mod solid_mesh;
mod surface_mesh;

use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    shaders.extend(own_shaders());
    shaders.extend(crate::lens::motion_shaders());
    shaders.extend(wgsl_files!("objects": "motion_pass"));
    shaders
}

/// Shader modules of this room alone.
pub(crate) fn own_shaders() -> impl Iterator<Item = (&'static str, String)> {
    let structs = records::ObjectRecord::declaration()
        + &records::PastPose::declaration()
        + &solid_mesh::SolidVertex::declaration();
    let structs = ("objects/structs", declarations([body::wgsl_constants()]) + &structs);
    wgsl_files!("objects": "object_shape", "object_pass").into_iter().chain([structs])
}
