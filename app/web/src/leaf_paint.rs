// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints packs of leaf pictures. A leaf takes seconds in a browser, so `scripts/web` has it done once, in Node.

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType as PngFilter, PngEncoder};
use image::{ExtendedColorType, GrayImage, ImageEncoder, RgbImage, RgbaImage};
use windfall_texgen::{Assortment, Layer, LeafForm, Shape};

use crate::error::WebError;
use crate::leaf_pack::{LEVELS, MAGIC, OFFSET_STEPS, PICTURE_SIZE, PLACE_STEPS};

/// Stretches of the season and leaves painted for each: some green ones, and more of autumn.
const SEASONS: [((f32, f32), u32); 2] = [((0.05, 0.25), 2), ((0.35, 0.95), 6)];
/// Seed of the leaves.
const SEED: u64 = 0x1eaf;
/// Quality of the JPEG pictures, 1 to 100.
const QUALITY: u8 = 88;

/// Paints a pack of leaves of a shape.
///
/// # Errors
/// Errors of the leaf maker.
pub(crate) fn paint(shape: Shape) -> Result<Vec<u8>, WebError> {
    let mut layers = Vec::new();
    for (season, count) in SEASONS {
        let assortment = Assortment { shape, season, count, size_px: PICTURE_SIZE, seed: SEED };
        layers.extend(assortment.make(|| {})?.leaves.iter().map(|leaf| Layer::of_leaf(leaf, PICTURE_SIZE)));
    }
    let mut out = MAGIC.to_vec();
    put(&mut out, layers.len());
    for layer in &layers {
        out.extend(layer.season.unwrap_or(0.0).to_le_bytes());
        let picture = &layer.mips[0];
        let alpha =
            GrayImage::from_fn(picture.width(), picture.height(), |x, y| [picture.get_pixel(x, y)[3]].into());
        for bytes in [jpeg(picture), png(&alpha), jpeg(&layer.surface[0])] {
            put(&mut out, bytes.len());
            out.extend(bytes);
        }
        put_form(&mut out, &layer.form);
    }
    Ok(out)
}

fn jpeg(picture: &RgbaImage) -> Vec<u8> {
    let rgb = RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let [r, g, b, _] = picture.get_pixel(x, y).0;
        [r, g, b].into()
    });
    let mut bytes = Vec::new();
    let encoder = JpegEncoder::new_with_quality(&mut bytes, QUALITY);
    let written = encoder.write_image(rgb.as_raw(), rgb.width(), rgb.height(), ExtendedColorType::Rgb8);
    written.expect("memory takes every byte");
    bytes
}

fn png(picture: &GrayImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, PngFilter::Adaptive);
    let written =
        encoder.write_image(picture.as_raw(), picture.width(), picture.height(), ExtendedColorType::L8);
    written.expect("memory takes every byte");
    bytes
}

/// Appends a count, of at most 32 bits.
fn put(out: &mut Vec<u8>, count: usize) {
    out.extend(u32::try_from(count).expect("packs are small").to_le_bytes());
}

/// Appends a number as a whole number of steps.
fn put_steps(out: &mut Vec<u8>, steps: f32, (low, high): (f32, f32)) {
    #[expect(clippy::cast_possible_truncation, reason = "within 16 bits")]
    let word = steps.round().clamp(low, high) as i32;
    out.extend(word.to_le_bytes().into_iter().take(2));
}

fn put_form(out: &mut Vec<u8>, form: &LeafForm) {
    let levels = &form.levels[..form.levels.len().min(LEVELS)];
    put(out, levels.len());
    for level in levels {
        put(out, level.positions.len());
        for place in level.positions.as_flattened() {
            put_steps(out, (place + 1.0) * PLACE_STEPS, (0.0, 65535.0));
        }
        put(out, level.triangles.len());
        for corner in level.triangles.as_flattened() {
            out.extend(corner.to_le_bytes().into_iter().take(2));
        }
        put(out, level.shapes.len());
        for shape in &level.shapes {
            out.extend(shape.water.to_le_bytes());
            for offset in shape.offsets.as_flattened() {
                put_steps(out, offset * OFFSET_STEPS, (-32767.0, 32767.0));
            }
        }
    }
}
