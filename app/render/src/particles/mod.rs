// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: sorted by distance, and drawn as balls, puffs, lights and ribbons, and the common surface of blobs.

pub(crate) mod blobs;
pub(crate) mod draw_list;
pub(crate) mod flames;
pub(crate) mod looks;
pub(crate) mod paint;
pub(crate) mod particle_pass;

use windfall_core::layout::WgslStruct;

use crate::gpu::radix_sort;
use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    shaders.extend(radix_sort::shaders());
    let structs = [
        looks::PopulationLook::declaration(),
        looks::LookRow::declaration(),
        draw_list::ParticleUniform::declaration(),
    ];
    let lists = [looks::wgsl_constants(), draw_list::wgsl_constants(), paint::wgsl_constants()];
    shaders.extend([(
        "particles/structs",
        "#import particle_records\n".to_owned()
            + &declarations(lists)
            + &structs.concat()
            + &blobs::structs()
            + &flames::structs(),
    )]);
    shaders.extend(wgsl_files!("particles": "bindings", "blob_field", "blob_list", "blob_pass", "blob_shadow", "draw_list", "fire_gather", "flame_pass", "flame_spine", "paint", "particle_pass", "ribbon", "ribbon_points"));
    shaders
}
