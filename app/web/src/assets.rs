// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes the small pictures of presets that the page shows, for `scripts/web`.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::{ImageFormat, ImageReader};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Width and height of a small picture in pixels.
const SIZE: (u32, u32) = (320, 180);
/// Quality of its JPEG, 1 to 100.
const QUALITY: u8 = 82;

/// A PNG of 16 by 9 as a small JPEG.
///
/// # Errors
/// Bytes that are no PNG.
#[wasm_bindgen]
pub fn thumbnail(png: &[u8]) -> Result<Vec<u8>, JsError> {
    let picture = ImageReader::with_format(Cursor::new(png), ImageFormat::Png).decode()?;
    let small = picture.thumbnail_exact(SIZE.0, SIZE.1).into_rgb8();
    let mut bytes = Vec::new();
    small.write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, QUALITY))?;
    Ok(bytes)
}
