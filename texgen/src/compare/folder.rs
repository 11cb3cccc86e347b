// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Folders of leaf pictures.

use std::fs;
use std::path::{Path, PathBuf};

use super::metric::Measured;
use crate::{Photo, Specimen, TexgenError};

/// Endings of pictures.
const ENDINGS: [&str; 4] = ["png", "jpg", "jpeg", "gif"];
/// Below this confidence leaves are taken to stand upright, the petiole down.
const UNSURE: f32 = 0.6;

/// A leaf of a folder with all that is measured of it.
#[derive(Clone, Debug)]
pub struct ComparedLeaf {
    /// Its file.
    pub path: PathBuf,
    /// The leaf.
    pub specimen: Specimen,
    /// Its measurements.
    pub measured: Measured,
}

impl ComparedLeaf {
    /// Reads a picture; NAME.mask.png beside NAME.png is its mask, otherwise its alpha channel or background serves.
    ///
    /// # Errors
    /// [`TexgenError::Photo`] if the picture or its mask cannot be used.
    pub fn read(path: &Path) -> Result<Self, TexgenError> {
        let beside = path.with_extension("mask.png");
        let mask = beside.is_file().then_some(beside.as_path());
        let mut specimen = Photo { path, mask, root: None }.extract()?.specimen;
        let blade = &mut specimen.blade;
        if blade.confidence < UNSURE && blade.root.y < blade.tip.y {
            std::mem::swap(&mut blade.root, &mut blade.tip);
        }
        let measured = Measured::of(&specimen);
        Ok(Self { path: path.into(), specimen, measured })
    }
}

/// Pictures of a folder in order of their names, without maps and masks (NAME.KIND.png).
///
/// # Errors
/// [`TexgenError::Photo`] if the folder cannot be read or holds no picture.
pub fn leaf_pictures(folder: &Path) -> Result<Vec<PathBuf>, TexgenError> {
    let fail = |problem: String| TexgenError::photo(folder.display().to_string(), problem);
    let entries = fs::read_dir(folder).map_err(|error| fail(error.to_string()))?;
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| fail(error.to_string()))?.path();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let is_picture = ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()));
        let is_map = path.file_stem().is_some_and(|stem| Path::new(stem).extension().is_some());
        if is_picture && !is_map && path.is_file() {
            paths.push(path);
        }
    }
    if paths.is_empty() {
        return Err(fail("no picture NAME.png, NAME.jpg or NAME.gif in this folder".into()));
    }
    paths.sort();
    Ok(paths)
}
