// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Surfaces out of glTF files.

use std::path::Path;

use glam::DVec3;
use thiserror::Error;

use crate::convert::single;
use crate::scene::limits;
use crate::surface::{Surface, SurfaceError};
use crate::tree::gltf::{GltfError, read_triangles};

/// Faults of a file as the surface of a solid thing.
#[derive(Debug, Error)]
pub(super) enum MeshError {
    /// A file that cannot be read.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// Triangles that enclose nothing.
    #[error("{file}, which {source}")]
    Surface { file: String, source: SurfaceError },
    /// A mesh that is too small or too large.
    #[error("{file}, which measures {size_m} m along an axis")]
    Size { file: String, size_m: f64 },
}

impl MeshError {
    /// Files that are allowed in place of the one with the fault.
    pub(super) fn allowed(&self) -> String {
        match self {
            Self::Gltf(_) => "a .gltf or .glb file with a closed mesh".into(),
            Self::Surface { source, .. } => source.allowed(),
            Self::Size { .. } => format!("{} to {} m", limits::OBJECT_SIZE_M.low, limits::OBJECT_SIZE_M.high),
        }
    }
}

/// The surface in a file, scaled.
pub(super) fn read(file: &str, scale: f32) -> Result<Surface, MeshError> {
    let given = read_triangles(Path::new(file))?;
    let corners_m: Vec<[f32; 3]> = given.positions_m.iter().map(|at| at.map(|m| m * scale)).collect();
    let surface = Surface::new(&corners_m, &given.triangles)
        .map_err(|source| MeshError::Surface { file: file.into(), source })?;
    let [low_m, high_m] = surface.extent_m();
    let size_m: DVec3 = high_m - low_m;
    let is_allowed = |size_m: &f64| limits::OBJECT_SIZE_M.contains(single(*size_m));
    match size_m.to_array().into_iter().find(|size_m| !is_allowed(size_m)) {
        Some(size_m) => Err(MeshError::Size { file: file.into(), size_m }),
        None => Ok(surface),
    }
}
