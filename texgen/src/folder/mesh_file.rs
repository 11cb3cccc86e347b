// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf's triangles and how they curl, as `NAME.mesh.ron` beside its pictures.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{FolderError, MAX_TEXT_BYTES};
use crate::form::{Detail, Drying, LeafMesh};
use crate::{Blade, TexgenError, VeinGraph, regular_file};

/// Meshes of one leaf, coarse first. All lengths are shares of the picture's side, x to the right and y down from its
/// upper left corner, z towards the viewer of the upper side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeafForm {
    /// Levels of detail.
    pub levels: Vec<FormLevel>,
}

/// One level of detail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FormLevel {
    /// Corners of the flat leaf; the first is where the petiole joins. They serve as texture coordinates too.
    pub positions: Vec<[f32; 2]>,
    /// Triangles, counter-clockwise as seen with y up.
    pub triangles: Vec<[u32; 3]>,
    /// Shapes of the drying leaf, from fresh to dry.
    pub shapes: Vec<FormShape>,
}

/// A shape to blend in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FormShape {
    /// Water left, as a share of the fresh leaf's.
    pub water: f32,
    /// Displacement of each corner.
    pub offsets: Vec<[f32; 3]>,
}

impl LeafForm {
    /// Triangulates and dries a leaf.
    pub(crate) fn of(
        blade: &Blade,
        veins: &VeinGraph,
        drying: &Drying,
        seed: u64,
    ) -> Result<Self, TexgenError> {
        let build = |detail| LeafMesh::build(blade, veins, detail);
        let meshes = Detail::ALL.into_iter().map(build).collect::<Result<Vec<_>, _>>()?;
        let shapes = drying.dry(&meshes, blade, seed);
        let scale = 1.0 / blade.mask.width.max(1) as f32;
        let levels = meshes.iter().zip(shapes).map(|(mesh, shapes)| FormLevel {
            positions: mesh.positions.iter().map(|p| (*p * scale).to_array()).collect(),
            triangles: mesh.triangles.clone(),
            shapes: shapes
                .into_iter()
                .map(|shape| FormShape {
                    water: shape.water,
                    offsets: shape.offsets.iter().map(|offset| (*offset * scale).to_array()).collect(),
                })
                .collect(),
        });
        Ok(Self { levels: levels.collect() })
    }

    /// Writes the meshes of the leaf `name` into a folder.
    ///
    /// # Errors
    /// [`FolderError::Write`] names the file.
    pub fn save(&self, folder: &Path, name: &str) -> Result<(), FolderError> {
        let path = folder.join(file_name(name));
        let text = ron::to_string(self).expect("a form is made of numbers and lists") + "\n";
        fs::write(&path, text).map_err(FolderError::write(&path))
    }

    /// Reads the meshes of the leaf `name`.
    ///
    /// # Errors
    /// [`FolderError`] for a file that is missing, is no form, or names corners that it does not have.
    pub fn load(folder: &Path, name: &str) -> Result<Self, FolderError> {
        let path = folder.join(file_name(name));
        let bytes = regular_file::read_in(folder, &file_name(name), MAX_TEXT_BYTES)
            .map_err(|source| FolderError::read(&path, source))?;
        let text = String::from_utf8_lossy(&bytes);
        let form: Self = ron::from_str(&text).map_err(|error| FolderError::Manifest {
            path: path.clone(),
            line: error.span.start.line,
            column: error.span.start.col,
            problem: error.code.to_string(),
        })?;
        for (index, level) in form.levels.iter().enumerate() {
            let refuse = |field: &str, value: usize, allowed| {
                let field = format!("levels[{index}].{field}");
                Err(FolderError::Field { path: path.clone(), field, value: value.to_string(), allowed })
            };
            let count = level.positions.len();
            if let Some(corner) =
                level.triangles.as_flattened().iter().find(|corner| **corner as usize >= count)
            {
                return refuse("triangles", *corner as usize, "a corner that is there");
            }
            if let Some(shape) = level.shapes.iter().find(|shape| shape.offsets.len() != count) {
                return refuse("shapes", shape.offsets.len(), "an offset for each corner");
            }
        }
        Ok(form)
    }
}

/// Name of the file.
pub(super) fn file_name(name: &str) -> String {
    format!("{name}.mesh.ron")
}
