// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: from a simulator's columns to records of those that a view shows, and from these to pictures of blades.

pub(crate) mod burning;
pub(crate) mod contact_pass;
pub(crate) mod cull;
pub(crate) mod leaf_pass;
pub(crate) mod meshes;
pub(crate) mod motion_pass;
pub(crate) mod page;
pub(crate) mod previous;
pub(crate) mod record;
pub(crate) mod small_leaf_light;
pub(crate) mod species_table;
mod strip;
pub(crate) mod visible;

use windfall_core::device::leaf::burn;
use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::trees::shaders();
    shaders.extend(crate::lens::motion_shaders());
    let structs = [
        species_table::SpeciesRow::declaration(),
        species_table::LayerRow::declaration(),
        species_table::SpeciesUniform::declaration(),
        meshes::LeafMesh::declaration(),
        record::LeafRecord::declaration(),
        record::LeafDraw::declaration(),
        record::LeafLight::declaration(),
        record::PageUniform::declaration(),
        record::ViewUniform::declaration(),
        burning::BurningUniform::declaration(),
    ];
    let lists = [
        meshes::wgsl_constants(),
        record::wgsl_constants(),
        burning::wgsl_constants(),
        burn::wgsl_constants(),
    ];
    let text = declarations(lists) + &burning::light_constants() + &structs.concat();
    shaders.extend([("leaves/structs", text)]);
    shaders.extend(wgsl_files!("leaves": "species_table", "shape", "front", "damage", "cull", "burning", "leaf_light", "leaf_pass", "small_leaf_light", "small_leaf_pass", "motion_pass", "contact_pass"));
    shaders
}
