// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow that lies, as in one frame: meshes with other corners in every frame are not in glTF's animations.

use gltf::json::material::AlphaMode;
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked::Valid;
use windfall_core::tree::gltf::new_mesh;

use super::file::Document;
use super::scenery::{plain, shown};
use crate::export::Frame;
use crate::export::snow_mesh::{SNOW, SnowMesh, cover};

/// Adds the snow of a frame, through which the ground shows where it is thin; nothing where none lies.
pub(super) fn add_snow(document: &mut Document, frame: &Frame<'_>) {
    let mesh = SnowMesh::of(frame.world);
    if mesh.triangles.is_empty() {
        return;
    }
    let material = plain(document, &SNOW);
    document.root.materials[material.value()].alpha_mode = Valid(AlphaMode::Blend);
    let colors: Vec<[f32; 4]> =
        mesh.depths_m.iter().map(|depth_m| [1.0, 1.0, 1.0, cover(*depth_m)]).collect();
    let depths_m: Vec<[f32; 1]> = mesh.depths_m.iter().map(|depth_m| [*depth_m]).collect();
    let attributes = [
        (Semantic::Positions, document.buffer.positions(&mesh.positions_m)),
        (Semantic::Normals, document.buffer.vertices(&mesh.normals)),
        (Semantic::Colors(0), document.buffer.vertices(&colors)),
        (Semantic::Extras("SNOW_DEPTH".into()), document.buffer.vertices(&depths_m)),
    ];
    let indices = document.buffer.indices(mesh.triangles.as_flattened());
    let mesh = document.root.push(new_mesh("Snow", attributes, Some(indices), Some(material)));
    document.add_root(shown("Snow".into(), mesh));
}
