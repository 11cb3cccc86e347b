// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files and folders that a scene names, and the folder that they lie in.

use std::path::Path;

use super::{ObjectShape, Scene, Sky};
use crate::SceneError;
use crate::regular_file::lies_below;

/// Files that a scene from a file may name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NamedFiles {
    /// Those in the folder of its file and below, after links are followed.
    #[default]
    Below,
    /// Any: the user trusts the scene.
    Anywhere,
}

impl Scene {
    /// Paths of the files and folders that the scene names: motion tables, leaves, trees and hulls, meshes of objects, the sky.
    pub fn files(&self) -> Vec<String> {
        self.clone().files_mut().into_iter().map(|(_, named)| named.clone()).collect()
    }

    /// The same with the fields that name them, to be changed.
    pub(super) fn files_mut(&mut self) -> Vec<(String, &mut String)> {
        let mut files = Vec::new();
        for (number, species) in self.species.iter_mut().enumerate() {
            let fields = [("tables", &mut species.tables), ("leaves", &mut species.leaves)];
            for (field, named) in fields {
                files.extend(named.as_mut().map(|named| (format!("species[{number}].{field}"), named)));
            }
        }
        for (number, kind) in self.tree_kinds.iter_mut().enumerate() {
            files.extend(kind.form.file_mut().map(|named| (format!("tree_kinds[{number}].form"), named)));
        }
        for (number, object) in self.objects.iter_mut().enumerate() {
            if let ObjectShape::Mesh { file, .. } = &mut object.shape {
                files.push((format!("objects[{number}].shape.file"), file));
            }
        }
        if let Sky::Map(map) = &mut self.view.sky {
            files.push(("view.sky.path".into(), &mut map.path));
        }
        files
    }

    /// Checks that all files that the scene names lie in `folder` or below, after links are followed. `file` is the name that errors give the
    /// scene.
    ///
    /// # Errors
    /// [`SceneError::Field`] for the first that does not.
    pub fn check_files_below(&self, folder: &Path, file: &str) -> Result<(), SceneError> {
        for (field, named) in self.clone().files_mut() {
            if !lies_below(folder, Path::new(named)) {
                return Err(SceneError::Field {
                    file: file.into(),
                    field,
                    value: format!("'{}', outside the folder of this file", named.escape_debug()),
                    allowed: "files in that folder and below, and others where the user allows them (--allow-outside)".into(),
                });
            }
        }
        Ok(())
    }
}
