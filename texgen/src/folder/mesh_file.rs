// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf's triangles and how they curl, as `NAME.mesh.ron` beside its pictures.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{FolderError, MAX_TEXT_BYTES};
use crate::form::{Detail, Drying, LeafMesh};
use crate::{Blade, TexgenError, VeinGraph, regular_file};

/// Most levels of detail.
const MOST_LEVELS: usize = 8;
/// Most corners of a level, which renderers number with 16 bits, and most triangles.
const MOST_CORNERS: usize = 1 << 16;
/// Most shapes of a level.
const MOST_SHAPES: usize = 16;
/// Farthest place in sides of the picture.
const FARTHEST: f32 = 100.0;

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
    /// [`FolderError`] for a file that is missing, is no form, names corners that it does not have, or has too many of anything.
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
        form.check(&path)?;
        Ok(form)
    }

    /// Checks every list and every number; `path` names the file in errors.
    fn check(&self, path: &Path) -> Result<(), FolderError> {
        let refuse = |field: String, value: String, allowed| {
            Err(FolderError::Field { path: path.to_owned(), field, value, allowed })
        };
        if self.levels.len() > MOST_LEVELS {
            return refuse("levels.len()".into(), self.levels.len().to_string(), "at most 8");
        }
        for (index, level) in self.levels.iter().enumerate() {
            let field = |name: &str| format!("levels[{index}].{name}");
            let count = level.positions.len();
            for (name, found, most, allowed) in [
                ("positions", count, MOST_CORNERS, "at most 65536"),
                ("triangles", level.triangles.len(), MOST_CORNERS, "at most 65536"),
                ("shapes", level.shapes.len(), MOST_SHAPES, "at most 16"),
            ] {
                if found > most {
                    return refuse(field(&format!("{name}.len()")), found.to_string(), allowed);
                }
            }
            let mut corners = level.triangles.as_flattened().iter();
            if let Some(corner) = corners.find(|corner| **corner as usize >= count) {
                return refuse(field("triangles"), corner.to_string(), "a corner that is there");
            }
            if let Some(shape) = level.shapes.iter().find(|shape| shape.offsets.len() != count) {
                return refuse(field("shapes"), shape.offsets.len().to_string(), "an offset for each corner");
            }
            let places = level.positions.as_flattened().iter();
            let shapes = || level.shapes.iter();
            let offsets = shapes().flat_map(|shape| shape.offsets.as_flattened());
            let water = shapes().map(|shape| &shape.water);
            let is_far = |number: &&f32| !(-FARTHEST..=FARTHEST).contains(*number);
            if let Some(number) = places.chain(offsets).chain(water).find(is_far) {
                return refuse(field("positions and shapes"), number.to_string(), "numbers from -100 to 100");
            }
        }
        Ok(())
    }
}

/// Name of the file.
pub(super) fn file_name(name: &str) -> String {
    format!("{name}.mesh.ron")
}
