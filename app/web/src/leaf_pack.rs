// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small pictures and meshes of leaves of one shape, as the page fetches them.
//!
//! A pack holds for each leaf its colour and surface as JPEG, its coverage as PNG, and its coarse and medium meshes with whole numbers for places.
//! `leaf_paint.rs` writes them.

use std::io::Cursor;

use image::imageops::{self, FilterType};
use image::{ImageFormat, ImageReader, Limits, RgbaImage};
use windfall_texgen::{FormLevel, FormShape, Layer, LeafForm};

use crate::error::WebError;

/// First bytes of a pack, with its version.
pub(crate) const MAGIC: &[u8; 8] = b"leaves 1";
/// Edge of a picture in texels.
pub(crate) const PICTURE_SIZE: u32 = 128;
/// Levels of detail that are kept: small pictures bear no finer ones.
pub(crate) const LEVELS: usize = 2;
/// Places of corners, from -1 to 2 sides of the picture, in 16 bits.
pub(crate) const PLACE_STEPS: f32 = 65535.0 / 3.0;
/// Displacements of corners, from -4 to 4 sides of the picture, in 16 bits with a sign.
pub(crate) const OFFSET_STEPS: f32 = 8191.0;
/// Most leaves of a pack, shapes of a level and bytes of a picture.
const MOST: [usize; 3] = [64, 16, 1 << 20];

/// Reads a pack; `file` is the name that errors give it.
///
/// # Errors
/// [`WebError::LeafPack`] for bytes that are no pack.
pub(crate) fn read(file: &str, bytes: &[u8]) -> Result<Vec<Layer>, WebError> {
    let mut reader = Reader { file, rest: bytes };
    if reader.bytes("version", MAGIC.len())? != MAGIC {
        return Err(reader.broken("version"));
    }
    let count = reader.count("leaf count", MOST[0])?;
    (0..count).map(|_| read_layer(&mut reader)).collect()
}

fn read_layer(reader: &mut Reader<'_>) -> Result<Layer, WebError> {
    let season = reader.float("season")?;
    let colour = reader.picture("colour", ImageFormat::Jpeg)?.into_rgb8();
    let alpha = reader.picture("coverage", ImageFormat::Png)?.into_luma8();
    let surface = reader.picture("surface", ImageFormat::Jpeg)?.into_rgb8();
    let form = read_form(reader)?;
    let picture = RgbaImage::from_fn(PICTURE_SIZE, PICTURE_SIZE, |x, y| {
        let [r, g, b] = colour.get_pixel(x, y).0;
        [r, g, b, alpha.get_pixel(x, y)[0]].into()
    });
    let surface = RgbaImage::from_fn(PICTURE_SIZE, PICTURE_SIZE, |x, y| {
        let [right, up, through] = surface.get_pixel(x, y).0;
        [right, up, through, u8::MAX].into()
    });
    Ok(Layer { surface: halved(surface), form, season: Some(season), ..Layer::from_picture(picture) })
}

/// All levels of a picture down to one texel.
fn halved(base: RgbaImage) -> Vec<RgbaImage> {
    let mut levels = vec![base];
    while let Some(last) = levels.last().filter(|level| level.width() > 1) {
        let half = last.width() / 2;
        let next = imageops::resize(last, half, half, FilterType::Triangle);
        levels.push(next);
    }
    levels
}

fn read_form(reader: &mut Reader<'_>) -> Result<LeafForm, WebError> {
    let count = reader.count("level count", LEVELS)?;
    let levels = (0..count).map(|_| {
        let corners = reader.count("corner count", usize::from(u16::MAX))?;
        let mut positions = vec![[0.0; 2]; corners];
        for place in positions.as_flattened_mut() {
            *place = f32::from(reader.word("corners")?) / PLACE_STEPS - 1.0;
        }
        let mut triangles = vec![[0; 3]; reader.count("triangle count", usize::from(u16::MAX))?];
        for corner in triangles.as_flattened_mut() {
            *corner = u32::from(reader.word("triangles")?);
            if *corner as usize >= corners {
                return Err(reader.broken("triangles"));
            }
        }
        let shapes = (0..reader.count("shape count", MOST[1])?).map(|_| {
            let water = reader.float("water")?;
            let mut offsets = vec![[0.0; 3]; corners];
            for offset in offsets.as_flattened_mut() {
                *offset = f32::from(reader.word("offsets")?.cast_signed()) / OFFSET_STEPS;
            }
            Ok(FormShape { water, offsets })
        });
        let shapes = shapes.collect::<Result<_, WebError>>()?;
        Ok(FormLevel { positions, triangles, shapes })
    });
    Ok(LeafForm { levels: levels.collect::<Result<_, WebError>>()? })
}

/// Bytes that are still to be read.
struct Reader<'a> {
    file: &'a str,
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn broken(&self, field: &'static str) -> WebError {
        WebError::LeafPack { file: self.file.into(), field }
    }

    fn bytes(&mut self, field: &'static str, count: usize) -> Result<&'a [u8], WebError> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| self.broken(field))?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], WebError> {
        let bytes = self.bytes(field, N)?;
        bytes.try_into().map_err(|_| self.broken(field))
    }

    fn word(&mut self, field: &'static str) -> Result<u16, WebError> {
        self.array(field).map(u16::from_le_bytes)
    }

    fn count(&mut self, field: &'static str, most: usize) -> Result<usize, WebError> {
        let count = u32::from_le_bytes(self.array(field)?) as usize;
        if count > most { Err(self.broken(field)) } else { Ok(count) }
    }

    fn float(&mut self, field: &'static str) -> Result<f32, WebError> {
        let value = f32::from_le_bytes(self.array(field)?);
        if value.is_finite() { Ok(value) } else { Err(self.broken(field)) }
    }

    fn picture(&mut self, field: &'static str, format: ImageFormat) -> Result<image::DynamicImage, WebError> {
        let length = self.count(field, MOST[2])?;
        let bytes = self.bytes(field, length)?;
        let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(PICTURE_SIZE), Some(PICTURE_SIZE));
        reader.limits(limits);
        let picture = reader.decode().map_err(|_| self.broken(field))?;
        let is_whole = picture.width() == PICTURE_SIZE && picture.height() == PICTURE_SIZE;
        if is_whole { Ok(picture) } else { Err(self.broken(field)) }
    }
}
