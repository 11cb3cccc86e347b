// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures and masks from files, whatever their kind.

use std::io::BufReader;
use std::path::Path;

use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, GrayImage, ImageReader, RgbImage};

use crate::{TexgenError, regular_file};

/// Largest picture that is read, in millions of pixels.
const MEGAPIXELS: u64 = 64;
/// Largest memory for decoding: 64 megapixels of four 16-bit channels, and as much again for the decoder.
const DECODER_BYTES: u64 = 1 << 30;
/// Grey level from which a mask's pixel belongs to the leaf.
const INSIDE: u8 = 128;

/// A picture with the mask that its alpha channel holds, if it says anything.
pub(crate) struct Picture {
    pub(crate) colours: RgbImage,
    pub(crate) opaque: Option<Vec<bool>>,
}

/// Reads a picture of any channel count and depth as 8-bit RGB.
///
/// # Errors
/// [`TexgenError::Photo`] for files that are missing, damaged, too large or no picture.
pub(crate) fn picture(path: &Path) -> Result<Picture, TexgenError> {
    let decoded = decode(path)?;
    let opaque = decoded
        .color()
        .has_alpha()
        .then(|| decoded.to_rgba8().pixels().map(|pixel| pixel.0[3] >= INSIDE).collect::<Vec<bool>>());
    let opaque = opaque.filter(|opaque| opaque.contains(&false));
    Ok(Picture { colours: decoded.into_rgb8(), opaque })
}

/// Reads a mask: light pixels belong to the leaf; with an alpha channel, opaque light ones.
///
/// # Errors
/// [`TexgenError::Photo`] for files that are missing, damaged, too large or no picture.
pub(crate) fn mask(path: &Path) -> Result<GrayImage, TexgenError> {
    let decoded = decode(path)?;
    if !decoded.color().has_alpha() {
        return Ok(decoded.into_luma8());
    }
    let mut grey = decoded.to_luma8();
    for (level, source) in grey.pixels_mut().zip(decoded.to_rgba8().pixels()) {
        level.0[0] = level.0[0].min(source.0[3]);
    }
    Ok(grey)
}

/// Returns true if a mask's level means leaf.
pub(crate) fn is_inside(level: u8) -> bool {
    level >= INSIDE
}

/// Decodes a file after a look at the size in its header.
fn decode(path: &Path) -> Result<DynamicImage, TexgenError> {
    let name = path.display().to_string();
    let problem = |error: ImageError| TexgenError::photo(name.clone(), describe(&error));
    let open = || {
        let unreadable = |error: std::io::Error| TexgenError::photo(name.clone(), error.to_string());
        // By what the file holds, whatever its name says.
        let reader = regular_file::open(path).map(|file| ImageReader::new(BufReader::new(file)));
        reader.and_then(ImageReader::with_guessed_format).map_err(unreadable)
    };
    let (width, height) = open()?.into_dimensions().map_err(problem)?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MEGAPIXELS * 1_000_000 {
        let size = format!("{width} × {height} pixels, allowed: at most {MEGAPIXELS} megapixels");
        return Err(TexgenError::photo(name, size));
    }
    let mut reader = open()?;
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(DECODER_BYTES);
    reader.limits(limits);
    reader.decode().map_err(problem)
}

/// Fault of a file, on one line.
fn describe(error: &ImageError) -> String {
    let text = match error {
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::InsufficientMemory) => {
            "needs too much memory to be read".into()
        }
        ImageError::Unsupported(_) => "no picture that can be read, allowed: PNG, JPEG, GIF".into(),
        ImageError::IoError(error) => format!("the file is cut off or cannot be read ({error})"),
        other => format!("the file is damaged ({other})"),
    };
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
