// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Packs of small leaves, one for each kind: bundled with the program and fetched by the page, for pictures before larger leaves are made.
//!
//! A pack holds, for each leaf, colour and surface as JPEG, coverage as PNG, and the coarse and the medium mesh in whole numbers.
//! `examples/leaf_packs.rs` writes the files of `packs/`; a test compares them with leaves made now.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType as PngFilter, PngEncoder};
use image::{DynamicImage, GrayImage, ImageFormat, ImageReader, Limits, RgbImage, RgbaImage};
use thiserror::Error;

use crate::layer::Layer;
use crate::making::RECIPE;
use crate::math::floor_i32;
use crate::mipmap;
use crate::{FolderLeaf, FormLevel, FormShape, LeafForm, LeafMaker, MakeOptions, Shape, TexgenError};

/// Side of the pictures in texels.
pub const PACK_SIZE_PX: u32 = 128;
/// Seasons that every pack has leaves of.
const SEASONS: [f32; 4] = [0.1, 0.4, 0.65, 0.92];
/// Leaves of a season.
const LEAVES_PER_SEASON: u32 = 2;
/// Side of the pictures that they are scaled down from.
const MADE_SIZE_PX: u32 = 512;
/// Seed of the leaves.
const SEED: u64 = 0x1eaf;
/// First bytes of a pack; the recipe follows.
const MAGIC: [u8; 4] = *b"WFLV";
/// Quality of the JPEG pictures, 1 to 100.
const QUALITY: u8 = 88;
/// Meshes that are kept: small pictures bear no finer ones.
const MESHES: usize = 2;
/// Steps of a coordinate for each side of the picture, and the step of zero: from -1 to 3 sides in 16 bits.
const STEPS: f32 = 16384.0;
const ZERO_STEP: f32 = 16384.0;
/// Most leaves of a pack, and most bytes of a picture.
const MOST_LEAVES: usize = 64;
const MOST_PICTURE_BYTES: usize = 1 << 20;

/// Small leaves of one kind.
#[derive(Clone, Debug)]
pub struct LeafPack(Vec<Layer>);

/// Bytes that are no pack.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{field} is broken; allowed: what scripts/leaf-packs writes")]
pub struct PackError {
    /// The part that cannot be read.
    pub field: &'static str,
}

impl LeafPack {
    /// The pack of a kind that is bundled with the program.
    pub fn bundled(shape: Shape) -> Self {
        Self::from_bytes(bundled_bytes(shape)).expect("a test reads every pack that is bundled")
    }

    /// Makes the leaves of a kind, which takes seconds.
    ///
    /// # Errors
    /// [`TexgenError`] if a leaf cannot be made.
    pub fn make(shape: Shape) -> Result<Self, TexgenError> {
        let mut leaves = Vec::new();
        for (first, season) in (0..).step_by(LEAVES_PER_SEASON as usize).zip(SEASONS) {
            let options = MakeOptions { size_px: MADE_SIZE_PX, season: Some(season), seed: SEED };
            let maker = LeafMaker::of_shape(shape, options)?;
            for number in first..first + LEAVES_PER_SEASON {
                let made = maker.make(number, false)?;
                let form = Some(maker.form(number)?);
                let leaf = FolderLeaf { facts: made.facts, maps: made.maps, form };
                leaves.push(Layer::of_leaf(&leaf, PACK_SIZE_PX));
            }
        }
        Ok(Self(leaves))
    }

    /// Leaves nearest to a stretch of the season, as layers of [`PACK_SIZE_PX`].
    pub fn in_season(&self, (earliest, latest): (f32, f32)) -> Vec<Layer> {
        let away = |layer: &&Layer| {
            let season = layer.season.unwrap_or_default();
            (earliest - season).max(season - latest).max(0.0)
        };
        let least = self.0.iter().map(|layer| away(&layer)).fold(f32::INFINITY, f32::min);
        self.0.iter().filter(|layer| away(layer) <= least).cloned().collect()
    }

    /// The bytes of a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(RECIPE.to_le_bytes());
        put_count(&mut bytes, self.0.len());
        for layer in &self.0 {
            bytes.extend(layer.season.unwrap_or_default().to_le_bytes());
            let (picture, surface) = (&layer.mips[0], &layer.surface[0]);
            for part in [jpeg(picture), coverage_png(picture), jpeg(surface)] {
                put_count(&mut bytes, part.len());
                bytes.extend(part);
            }
            for level in &layer.form.levels[..MESHES] {
                put_level(&mut bytes, level);
            }
        }
        bytes
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// [`PackError`] for bytes that are no pack, or one of another recipe.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PackError> {
        let mut reader = Reader(bytes);
        if reader.array("format")? != MAGIC {
            return Err(PackError { field: "format" });
        }
        if u32::from_le_bytes(reader.array("recipe")?) != RECIPE {
            return Err(PackError { field: "recipe" });
        }
        let count = reader.count("leaf count", MOST_LEAVES)?;
        (0..count).map(|_| reader.layer()).collect::<Result<_, _>>().map(Self)
    }
}

fn bundled_bytes(shape: Shape) -> &'static [u8] {
    match shape {
        Shape::Maple => include_bytes!("../packs/maple.leaves"),
        Shape::JapaneseMaple => include_bytes!("../packs/japanese-maple.leaves"),
        Shape::Oak => include_bytes!("../packs/oak.leaves"),
        Shape::Birch => include_bytes!("../packs/birch.leaves"),
        Shape::Beech => include_bytes!("../packs/beech.leaves"),
        Shape::Hornbeam => include_bytes!("../packs/hornbeam.leaves"),
        Shape::Linden => include_bytes!("../packs/linden.leaves"),
        Shape::Ginkgo => include_bytes!("../packs/ginkgo.leaves"),
    }
}

fn jpeg(picture: &RgbaImage) -> Vec<u8> {
    let plain = RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let [r, g, b, _] = picture.get_pixel(x, y).0;
        [r, g, b].into()
    });
    let mut bytes = Vec::new();
    let written = plain.write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, QUALITY));
    written.expect("memory takes every picture");
    bytes
}

fn coverage_png(picture: &RgbaImage) -> Vec<u8> {
    let coverage =
        GrayImage::from_fn(picture.width(), picture.height(), |x, y| [picture.get_pixel(x, y)[3]].into());
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, PngFilter::Adaptive);
    coverage.write_with_encoder(encoder).expect("memory takes every picture");
    bytes
}

fn put_count(bytes: &mut Vec<u8>, count: usize) {
    bytes.extend(u32::try_from(count).expect("packs are small").to_le_bytes());
}

fn put_places<'a>(bytes: &mut Vec<u8>, places: impl IntoIterator<Item = &'a f32>) {
    for place in places {
        let steps = (place * STEPS + ZERO_STEP + 0.5).clamp(0.0, f32::from(u16::MAX));
        bytes.extend(u16::try_from(floor_i32(steps)).expect("within 16 bits").to_le_bytes());
    }
}

fn put_level(bytes: &mut Vec<u8>, level: &FormLevel) {
    for count in [level.positions.len(), level.triangles.len(), level.shapes.len()] {
        put_count(bytes, count);
    }
    put_places(bytes, level.positions.iter().flatten());
    for corner in level.triangles.iter().flatten() {
        bytes.extend(u16::try_from(*corner).expect("meshes are small").to_le_bytes());
    }
    for shape in &level.shapes {
        bytes.extend(shape.water.to_le_bytes());
        put_places(bytes, shape.offsets.iter().flatten());
    }
}

/// Bytes that are still to be read.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn bytes(&mut self, field: &'static str, count: usize) -> Result<&'a [u8], PackError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(PackError { field })?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], PackError> {
        self.bytes(field, N)?.try_into().map_err(|_| PackError { field })
    }

    fn count(&mut self, field: &'static str, most: usize) -> Result<usize, PackError> {
        let count = u32::from_le_bytes(self.array(field)?) as usize;
        if count > most { Err(PackError { field }) } else { Ok(count) }
    }

    fn float(&mut self, field: &'static str) -> Result<f32, PackError> {
        let value = f32::from_le_bytes(self.array(field)?);
        if value.is_finite() { Ok(value) } else { Err(PackError { field }) }
    }

    fn word(&mut self, field: &'static str) -> Result<u16, PackError> {
        self.array(field).map(u16::from_le_bytes)
    }

    fn places<const N: usize>(
        &mut self,
        field: &'static str,
        count: usize,
    ) -> Result<Vec<[f32; N]>, PackError> {
        let mut places = vec![[0.0; N]; count];
        for place in places.as_flattened_mut() {
            *place = (f32::from(self.word(field)?) - ZERO_STEP) / STEPS;
        }
        Ok(places)
    }

    fn picture(&mut self, field: &'static str, format: ImageFormat) -> Result<DynamicImage, PackError> {
        let length = self.count(field, MOST_PICTURE_BYTES)?;
        let mut reader = ImageReader::with_format(Cursor::new(self.bytes(field, length)?), format);
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(PACK_SIZE_PX), Some(PACK_SIZE_PX));
        reader.limits(limits);
        let picture = reader.decode().map_err(|_| PackError { field })?;
        let is_whole = (picture.width(), picture.height()) == (PACK_SIZE_PX, PACK_SIZE_PX);
        if is_whole { Ok(picture) } else { Err(PackError { field }) }
    }

    fn level(&mut self) -> Result<FormLevel, PackError> {
        let most = usize::from(u16::MAX);
        let [corners, triangles, shapes] = [
            self.count("corner count", most)?,
            self.count("triangle count", most)?,
            self.count("shape count", MOST_LEAVES)?,
        ];
        let positions = self.places("corners", corners)?;
        let mut indices = vec![[0; 3]; triangles];
        for corner in indices.as_flattened_mut() {
            *corner = u32::from(self.word("triangles")?);
            if *corner as usize >= corners {
                return Err(PackError { field: "triangles" });
            }
        }
        let shape = |_| {
            let water = self.float("water")?;
            Ok(FormShape { water, offsets: self.places("offsets", corners)? })
        };
        let shapes = (0..shapes).map(shape).collect::<Result<_, _>>()?;
        Ok(FormLevel { positions, triangles: indices, shapes })
    }

    fn layer(&mut self) -> Result<Layer, PackError> {
        let season = self.float("season")?;
        let colour = self.picture("colour", ImageFormat::Jpeg)?.into_rgb8();
        let coverage = self.picture("coverage", ImageFormat::Png)?.into_luma8();
        let surface = self.picture("surface", ImageFormat::Jpeg)?.into_rgb8();
        let [coarse, medium] = [self.level()?, self.level()?];
        let with_fourth = |picture: &RgbImage, fourth: &dyn Fn(u32, u32) -> u8| {
            RgbaImage::from_fn(PACK_SIZE_PX, PACK_SIZE_PX, |x, y| {
                let [r, g, b] = picture.get_pixel(x, y).0;
                [r, g, b, fourth(x, y)].into()
            })
        };
        let picture = with_fourth(&colour, &|x, y| coverage.get_pixel(x, y)[0]);
        Ok(Layer {
            surface: mipmap::plain_chain(with_fourth(&surface, &|_, _| u8::MAX)),
            form: LeafForm { levels: vec![coarse, medium.clone(), medium] },
            season: Some(season),
            ..Layer::from_picture(picture)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_leaves_of_every_season() {
        for shape in Shape::ALL {
            let pack = LeafPack::from_bytes(bundled_bytes(shape))
                .unwrap_or_else(|error| panic!("{shape:?}: {error}"));
            assert_eq!(pack.0.len(), SEASONS.len() * LEAVES_PER_SEASON as usize, "{shape:?}");
            for (season, nearest) in [((0.0, 0.0), 2), ((0.3, 0.7), 4), ((0.5, 0.5), 2), ((0.0, 1.0), 8)] {
                let layers = pack.in_season(season);
                assert_eq!(layers.len(), nearest, "{shape:?} in {season:?}");
                for layer in layers {
                    assert!((0.1..0.9).contains(&layer.area_fraction), "{shape:?}: {}", layer.area_fraction);
                    assert!(layer.form.levels.iter().all(|level| level.shapes.len() > 1), "{shape:?} dries");
                }
            }
        }
    }

    #[test]
    fn bundled_packs_are_what_is_made_now_and_read_back_nearly_the_same() {
        let made = LeafPack::make(Shape::Ginkgo).expect("it grows");
        let bytes = made.to_bytes();
        assert!(bytes == bundled_bytes(Shape::Ginkgo), "other leaves: run scripts/leaf-packs");
        let read = LeafPack::from_bytes(&bytes).expect("just written");
        for (made, read) in made.0.iter().zip(&read.0) {
            assert_eq!(made.season, read.season, "its season");
            assert!((made.area_fraction - read.area_fraction).abs() < 1e-6, "its coverage is kept");
            let texels = || made.mips[0].pixels().zip(read.mips[0].pixels());
            let off: u64 = texels().map(|(a, b)| u64::from(a[0].abs_diff(b[0]))).sum();
            assert!(off < 6 * u64::from(PACK_SIZE_PX * PACK_SIZE_PX), "red is off by {off} in all");
            for (made, read) in made.form.levels.iter().zip(&read.form.levels).take(MESHES) {
                assert_eq!(made.triangles, read.triangles, "its triangles");
                let places = |level: &FormLevel| {
                    let offsets = level.shapes.iter().flat_map(|shape| shape.offsets.iter().flatten());
                    level.positions.iter().flatten().chain(offsets).copied().collect::<Vec<f32>>()
                };
                let mut pairs = places(made).into_iter().zip(places(read));
                assert!(pairs.all(|(a, b)| (a - b).abs() < 1.0 / STEPS), "within a step");
            }
        }
    }

    #[test]
    fn broken_packs_are_refused() {
        let whole = bundled_bytes(Shape::Birch);
        for end in (0..whole.len()).step_by(whole.len() / 40) {
            assert!(LeafPack::from_bytes(&whole[..end]).is_err(), "{end} bytes");
        }
        let mut other = whole.to_vec();
        other[4] ^= 1;
        assert_eq!(
            LeafPack::from_bytes(&other).map(|_| ()),
            Err(PackError { field: "recipe" }),
            "another recipe"
        );
    }
}
