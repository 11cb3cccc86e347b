// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Refusal of meshes, in place of `mesh_file` without the feature `gltf`.

use thiserror::Error;

use crate::surface::Surface;

/// A mesh at all.
#[derive(Debug, Error)]
#[error("{file}: the feature gltf is off")]
pub(super) struct MeshError {
    file: String,
}

impl MeshError {
    /// Shapes that are allowed in place of a mesh.
    #[expect(clippy::unused_self, reason = "as with the feature")]
    pub(super) fn allowed(&self) -> String {
        "shapes without a file".into()
    }
}

/// Refuses the file.
pub(super) fn read(file: &str, _: f32) -> Result<Surface, MeshError> {
    Err(MeshError { file: file.into() })
}
