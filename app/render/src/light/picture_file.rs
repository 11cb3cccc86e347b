// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads pictures of high dynamic range, and trusts none of them.

use std::fs;
use std::io::Cursor;

use exr::meta::{BlockDescription, MetaData};
use glam::Vec3;
use image::codecs::hdr::HdrDecoder;
use image::codecs::openexr::OpenExrDecoder;
use image::{ImageDecoder, ImageError};
use windfall_core::read_regular_file;

use super::MapError;

/// Most pixels of a picture: 8192 by 4096, which take 400 MB while they are read.
const MAX_PIXELS: u64 = 8192 * 4096;
/// Least height of a picture in pixels.
const MIN_HEIGHT: u32 = 8;
/// Largest file in bytes: four bytes for each channel of the largest picture, and some words.
const MAX_BYTES: u64 = MAX_PIXELS * 16 + (1 << 20);
/// Largest value of a channel; what lies above it comes from broken files rather than from the sun.
const MAX_VALUE: f32 = 1e9;

/// A picture as it stands in a file: rows of linear sRGB, top first.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<Vec3>,
}

impl Picture {
    /// Reads a Radiance or an OpenEXR file, whichever its first bytes announce.
    ///
    /// # Errors
    /// A file that cannot be read, is of another kind, broken or too large, or holds what is no light.
    pub(super) fn read(path: &str) -> Result<Self, MapError> {
        Self::from_bytes(path, &read_file(path)?)
    }

    /// The same from the bytes of a file; `path` is the name that errors give it.
    ///
    /// # Errors
    /// Bytes of another kind, broken or too many, or that hold what is no light.
    pub(super) fn from_bytes(path: &str, bytes: &[u8]) -> Result<Self, MapError> {
        let length = bytes.len() as u64;
        if length > MAX_BYTES {
            return Err(MapError::Bytes { file: path.into(), length, allowed: MAX_BYTES });
        }
        if bytes.starts_with(b"#?") {
            Self::decode(path, HdrDecoder::new_nonstrict(Cursor::new(bytes)))
        } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
            check_layers(path, bytes)?;
            Self::decode(path, OpenExrDecoder::with_alpha_preference(Cursor::new(bytes), Some(false)))
        } else {
            Err(MapError::Kind { file: path.into() })
        }
    }

    fn decode(path: &str, decoder: Result<impl ImageDecoder, ImageError>) -> Result<Self, MapError> {
        let broken = |source| MapError::Broken { file: path.into(), source };
        let decoder = decoder.map_err(broken)?;
        let (width, height) = decoder.dimensions();
        if height < MIN_HEIGHT || u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(MapError::Size { file: path.into(), width, height });
        }
        check_aspect(path, width, height)?;
        let mut values = vec![0.0f32; 3 * width as usize * height as usize];
        decoder.read_image(bytemuck::cast_slice_mut(&mut values)).map_err(broken)?;
        let is_light = |value: &f32| (0.0..=MAX_VALUE).contains(value);
        if let Some(at) = values.iter().position(|value| !is_light(value)) {
            let pixel = at / 3;
            let (x, y) = (pixel % width as usize, pixel / width as usize);
            return Err(MapError::Value { file: path.into(), x, y, value: values[at] });
        }
        let pixels: Vec<Vec3> = values.as_chunks::<3>().0.iter().map(|&pixel| pixel.into()).collect();
        if pixels.iter().all(|pixel| *pixel == Vec3::ZERO) {
            return Err(MapError::Black { file: path.into() });
        }
        Ok(Self { width: width as usize, height: height as usize, pixels })
    }
}

/// The bytes of a file of a sensible size.
fn read_file(path: &str) -> Result<Vec<u8>, MapError> {
    let length = fs::metadata(path).map_or(0, |file| file.len());
    if length > MAX_BYTES {
        return Err(MapError::Bytes { file: path.into(), length, allowed: MAX_BYTES });
    }
    read_regular_file(path.as_ref(), MAX_BYTES).map_err(|source| MapError::Read { file: path.into(), source })
}

/// Refuses an OpenEXR file with a layer that is larger than any allowed picture, of which the picture may show a corner alone: blocks
/// are decoded whole.
fn check_layers(path: &str, bytes: &[u8]) -> Result<(), MapError> {
    // The decoder says what is wrong with a head that cannot be read.
    let Ok(head) = MetaData::read_from_buffered(bytes, false) else { return Ok(()) };
    for header in &head.headers {
        let tile = match header.blocks {
            BlockDescription::ScanLines => header.layer_size,
            BlockDescription::Tiles(tiles) => tiles.tile_size,
        };
        for size in [header.layer_size, tile] {
            // Sides are below 2^31, and the bytes of a pixel come from a list in the file.
            let pixels = size.width() as u128 * size.height() as u128;
            let length = pixels * header.channels.bytes_per_pixel as u128;
            if length > MAX_BYTES.into() {
                let length = u64::try_from(length).unwrap_or(u64::MAX);
                return Err(MapError::Bytes { file: path.into(), length, allowed: MAX_BYTES });
            }
        }
    }
    Ok(())
}

/// Allows what the shapes of maps are.
fn check_aspect(path: &str, width: u32, height: u32) -> Result<(), MapError> {
    let (width, height) = (u64::from(width), u64::from(height));
    if width == 2 * height || 3 * width == 4 * height || 4 * width == 3 * height {
        return Ok(());
    }
    Err(MapError::Aspect { file: path.into(), width, height })
}
