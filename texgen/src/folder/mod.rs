// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves as a folder: for each a colour picture with alpha and four maps as PNG files, and one manifest.
//!
//! `NAME.png` holds sRGB colour and straight alpha, petiole down; beside it lie `NAME.normal.png`,
//! `NAME.height.png`, `NAME.translucency.png` and `NAME.mask.png`, see
//! [`LeafMaps`]. `NAME.mesh.ron` holds its meshes if it has any, see [`LeafForm`].

mod camber;
mod error;
mod manifest;
mod mesh_file;

use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Write};
use std::path::Path;

use image::codecs::png::{PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::LeafMaps;
use crate::regular_file;
pub use error::FolderError;
pub use manifest::{BodyFacts, FOLDER_VERSION, LeafFacts, MANIFEST_NAME, Manifest, PetioleFacts};
pub use mesh_file::{FormLevel, FormShape, LeafForm};

/// Largest file of text in bytes: a manifest or meshes of a leaf.
const MAX_TEXT_BYTES: u64 = 64 << 20;
/// Most bytes that decoding takes beside the pixels, such as those of a colour profile: more than the largest picture has.
const DECODER_BYTES: u64 = 160 << 20;
/// Endings of a leaf's five pictures.
const ENDINGS: [&str; 5] = ["png", "normal.png", "height.png", "translucency.png", "mask.png"];

/// A finished leaf: numbers and pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct FolderLeaf {
    /// Numbers.
    pub facts: LeafFacts,
    /// Pictures.
    pub maps: LeafMaps,
    /// Meshes, if the leaf has any.
    pub form: Option<LeafForm>,
}

/// Leaves that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafFolder {
    /// Side of every picture in pixels, a power of two from 16 to 4096.
    pub size_px: u32,
    /// The leaves, 1 to 4096.
    pub leaves: Vec<FolderLeaf>,
}

impl LeafFolder {
    /// Names of all files that [`LeafFolder::save`] writes, the manifest last.
    pub fn file_names(&self) -> Vec<String> {
        let pictures = self.leaves.iter().flat_map(|leaf| leaf.facts.file_names());
        pictures.chain([MANIFEST_NAME.to_owned()]).collect()
    }

    /// Writes all files into a folder that is there. The manifest is written last: without it, the files are no
    /// folder of leaves.
    ///
    /// # Errors
    /// [`FolderError::Write`] names the file.
    pub fn save(&self, folder: &Path) -> Result<(), FolderError> {
        self.leaves.par_iter().map(|leaf| leaf.save(folder)).collect::<Result<Vec<()>, _>>()?;
        let facts = self.leaves.iter().map(|leaf| leaf.facts.clone()).collect();
        Manifest { version: FOLDER_VERSION, size_px: self.size_px, leaves: facts }.save(folder)
    }

    /// Reads a folder.
    ///
    /// # Errors
    /// [`FolderError`] for a file that is missing, cannot be read or decoded, or does not fit the manifest.
    pub fn load(folder: &Path) -> Result<Self, FolderError> {
        let manifest = Manifest::load(folder)?;
        let load = |facts: &LeafFacts| FolderLeaf::load(folder, facts, manifest.size_px);
        let leaves = manifest.leaves.par_iter().map(load).collect::<Result<_, _>>()?;
        Ok(Self { size_px: manifest.size_px, leaves })
    }
}

impl AsRef<LeafFacts> for FolderLeaf {
    fn as_ref(&self) -> &LeafFacts {
        &self.facts
    }
}

impl LeafFacts {
    /// Names of the leaf's files.
    pub fn file_names(&self) -> Vec<String> {
        let pictures = ENDINGS.iter().map(|ending| format!("{}.{ending}", self.name));
        pictures.chain(self.has_mesh.then(|| mesh_file::file_name(&self.name))).collect()
    }
}

impl Manifest {
    /// Reads the manifest of a folder, and no picture.
    ///
    /// # Errors
    /// [`FolderError`] for a manifest that is missing, cannot be read, or holds what is not allowed.
    pub fn load(folder: &Path) -> Result<Self, FolderError> {
        let path = folder.join(MANIFEST_NAME);
        let bytes = regular_file::read_in(folder, MANIFEST_NAME, MAX_TEXT_BYTES)
            .map_err(|source| FolderError::read(&path, source))?;
        let text = std::str::from_utf8(&bytes).map_err(|error| FolderError::Manifest {
            path: path.clone(),
            line: 1,
            column: 1,
            problem: error.to_string(),
        })?;
        Self::from_text(text, &path)
    }

    /// Writes the manifest into a folder.
    ///
    /// # Errors
    /// [`FolderError::Write`] names the file.
    pub fn save(&self, folder: &Path) -> Result<(), FolderError> {
        let path = folder.join(MANIFEST_NAME);
        fs::write(&path, self.to_text()).map_err(FolderError::write(&path))
    }
}

impl FolderLeaf {
    /// Writes the files of one leaf into a folder.
    ///
    /// # Errors
    /// [`FolderError::Write`] names the file.
    pub fn save(&self, folder: &Path) -> Result<(), FolderError> {
        let maps = &self.maps;
        let grey = ExtendedColorType::L8;
        let pictures: [(&[u8], ExtendedColorType); 5] = [
            (maps.albedo.as_raw(), ExtendedColorType::Rgba8),
            (maps.normal.as_raw(), ExtendedColorType::Rgb8),
            (maps.height.as_raw(), grey),
            (maps.translucency.as_raw(), grey),
            (maps.mask.as_raw(), grey),
        ];
        let (width, height) = maps.albedo.dimensions();
        for (ending, (bytes, colour)) in ENDINGS.iter().zip(pictures) {
            let path = folder.join(format!("{}.{ending}", self.facts.name));
            let file = File::create(&path).map_err(FolderError::write(&path))?;
            let mut out = BufWriter::new(file);
            PngEncoder::new(&mut out)
                .write_image(bytes, width, height, colour)
                .map_err(|error| FolderError::write(&path)(std::io::Error::other(error)))?;
            out.flush().map_err(FolderError::write(&path))?;
        }
        self.form.as_ref().map_or(Ok(()), |form| form.save(folder, &self.facts.name))
    }

    fn load(folder: &Path, facts: &LeafFacts, size_px: u32) -> Result<Self, FolderError> {
        let read = |ending: &str| picture(folder, &format!("{}.{ending}", facts.name), size_px);
        let maps = LeafMaps {
            albedo: read(ENDINGS[0])?.into_rgba8(),
            normal: read(ENDINGS[1])?.into_rgb8(),
            height: read(ENDINGS[2])?.into_luma8(),
            translucency: read(ENDINGS[3])?.into_luma8(),
            mask: read(ENDINGS[4])?.into_luma8(),
        };
        let form = facts.has_mesh.then(|| LeafForm::load(folder, &facts.name)).transpose()?;
        Ok(Self { facts: facts.clone(), maps, form })
    }
}

/// Reads a PNG file of a known size; the size is checked before any pixel is decoded.
fn picture(folder: &Path, name: &str, size_px: u32) -> Result<DynamicImage, FolderError> {
    let path = folder.join(name);
    let broken =
        |error: image::ImageError| FolderError::Picture { path: path.clone(), problem: error.to_string() };
    let file = regular_file::open_in(folder, name).map_err(|source| FolderError::read(&path, source))?;
    let mut limits = image::Limits::no_limits();
    limits.max_alloc = Some(DECODER_BYTES);
    let decoder = PngDecoder::with_limits(BufReader::new(file), limits).map_err(broken)?;
    let found = decoder.dimensions();
    if found != (size_px, size_px) {
        return Err(FolderError::Size { path: path.clone(), found, allowed: size_px });
    }
    DynamicImage::from_decoder(decoder).map_err(broken)
}

#[cfg(test)]
mod tests;
