// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes what the page fetches besides its module, for `scripts/web`: packs of leaf pictures and small pictures of the presets.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::{ImageFormat, ImageReader};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::leaf_paint;
use crate::leaf_pictures::PACKS;

/// Width and height of a small picture in pixels.
const SIZE: (u32, u32) = (320, 180);
/// Quality of its JPEG, 1 to 100.
const QUALITY: u8 = 82;

/// Names of the packs of leaf pictures.
#[wasm_bindgen]
pub fn leaf_packs() -> Vec<String> {
    PACKS.iter().map(|&(name, _)| name.to_owned()).collect()
}

/// Paints a pack of leaf pictures, which takes seconds.
///
/// # Errors
/// A name that no pack has.
#[wasm_bindgen]
pub fn paint_leaf_pack(name: &str) -> Result<Vec<u8>, JsError> {
    let (_, shape) = PACKS
        .into_iter()
        .find(|(pack, _)| *pack == name)
        .ok_or_else(|| JsError::new(&format!("pack is '{name}'; allowed: {}", leaf_packs().join(", "))))?;
    Ok(leaf_paint::paint(shape)?)
}

/// A PNG of 16 by 9 as a small JPEG, for `scripts/web`.
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
