// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of leaves as PNG files.

use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use image::{ImageFormat, RgbImage};

use crate::files::{OutputFile, write_error};

/// Writes a picture, complete or not at all.
///
/// # Errors
/// Whatever keeps the file from being written, named with its path.
pub(super) fn write(path: &Path, picture: &RgbImage) -> anyhow::Result<()> {
    let mut file = OutputFile::create(path)?;
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png)?;
    file.write_all(bytes.get_ref()).map_err(|error| write_error(path, &error))?;
    file.finish()
}

/// Reads the name of a PNG file on the command line.
///
/// # Errors
/// Names the allowed ending.
pub(super) fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("allowed: a file name that ends in .png".into()) }
}
