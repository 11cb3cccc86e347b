// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small leaves of every kind that come with the program: for a first picture, until better ones are made.
//!
//! A kind has a sheet, a PNG file with a column for each leaf (colour and coverage above, surface below), and a file with meshes.
//! `examples/ready_leaves.rs` makes both anew; a test compares them with leaves made now.

use image::codecs::png::{CompressionType, FilterType as PngFilter, PngEncoder};
use image::imageops;
use image::{ImageFormat, RgbaImage};

use crate::layer::Layer;
use crate::making::{PETIOLE_DROOP_DEG, RECIPE};
use crate::math::floor_i32;
use crate::{FolderLeaf, FormLevel, FormShape, LeafForm, LeafMaker, MakeOptions, Shape, TexgenError};

/// Side of the pictures in texels.
pub const READY_SIZE_PX: u32 = 128;
/// Seasons that every kind has leaves of.
const SEASONS: [f32; 4] = [0.1, 0.4, 0.65, 0.92];
/// Leaves of a season.
const LEAVES: u32 = 2;
/// Side of the pictures that they are scaled down from.
const MADE_SIZE_PX: u32 = 512;
/// Seed of the leaves.
const SEED: u64 = 0x1eaf;
/// First bytes of a file of meshes.
const MAGIC: [u8; 4] = *b"WFLV";
/// Coordinates for each side of a picture, and the place of zero among 16 bits.
const UNITS: f32 = 16384.0;
const ZERO: f32 = 16384.0;

/// Leaves of a kind, unpacked.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadyLeaves(Vec<ReadyLeaf>);

/// Files of a kind of ready leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadyFiles {
    /// A PNG file.
    pub sheet: Vec<u8>,
    /// Meshes.
    pub forms: Vec<u8>,
}

#[derive(Clone, Debug, PartialEq)]
struct ReadyLeaf {
    season: f32,
    picture: RgbaImage,
    surface: RgbaImage,
    form: LeafForm,
}

impl ReadyLeaves {
    /// The leaves of a shape that come with the program.
    pub fn of(shape: Shape) -> Self {
        let (sheet, forms) = embedded(shape);
        Self::from_bytes(sheet, forms).expect("a test unpacks every file that is embedded")
    }

    /// The leaves of [`ReadyFiles`]; `None` if they are not of this format and recipe.
    pub fn from_bytes(sheet: &[u8], forms: &[u8]) -> Option<Self> {
        unpack(sheet, forms).map(Self)
    }

    /// Those nearest to a stretch of the season, as layers of [`READY_SIZE_PX`].
    pub fn layers(&self, (earliest, latest): (f32, f32)) -> Vec<Layer> {
        let away = |leaf: &&ReadyLeaf| (earliest - leaf.season).max(leaf.season - latest).max(0.0);
        let least = self.0.iter().map(|leaf| away(&leaf)).fold(f32::INFINITY, f32::min);
        let nearest = self.0.iter().filter(|leaf| away(leaf) <= least);
        nearest.map(ReadyLeaf::layer).collect()
    }
}

impl ReadyLeaf {
    fn layer(&self) -> Layer {
        let (picture, surface) = (self.picture.clone(), self.surface.clone());
        Layer::assembled(picture, surface, Some(&self.form), PETIOLE_DROOP_DEG, self.season)
    }
}

impl ReadyFiles {
    /// Makes the leaves of a shape and packs them.
    ///
    /// # Errors
    /// [`TexgenError`] if a leaf cannot be made.
    pub fn make(shape: Shape) -> Result<Self, TexgenError> {
        let mut leaves = Vec::new();
        for (number, season) in (0..).step_by(LEAVES as usize).zip(SEASONS) {
            let options = MakeOptions { size_px: MADE_SIZE_PX, season: Some(season), seed: SEED };
            let maker = LeafMaker::of_shape(shape, options)?;
            for number in number..number + LEAVES {
                let made = maker.make(number, false)?;
                let form = maker.form(number)?;
                let leaf = FolderLeaf { facts: made.facts, maps: made.maps, form: None };
                let (picture, surface) = Layer::pictures_of(&leaf, READY_SIZE_PX);
                leaves.push(ReadyLeaf { season, picture, surface, form });
            }
        }
        Ok(pack(&leaves))
    }
}

/// Sheet and meshes of a shape.
fn embedded(shape: Shape) -> (&'static [u8], &'static [u8]) {
    macro_rules! files {
        ($name:literal) => {
            (
                include_bytes!(concat!("../ready/", $name, ".png")),
                include_bytes!(concat!("../ready/", $name, ".forms")),
            )
        };
    }
    match shape {
        Shape::Maple => files!("maple"),
        Shape::JapaneseMaple => files!("japanese-maple"),
        Shape::Oak => files!("oak"),
        Shape::Birch => files!("birch"),
        Shape::Beech => files!("beech"),
        Shape::Hornbeam => files!("hornbeam"),
        Shape::Linden => files!("linden"),
        Shape::Ginkgo => files!("ginkgo"),
    }
}

fn pack(leaves: &[ReadyLeaf]) -> ReadyFiles {
    let count = u32::try_from(leaves.len()).expect("a few");
    let mut sheet = RgbaImage::new(count * READY_SIZE_PX, 2 * READY_SIZE_PX);
    let mut forms = MAGIC.to_vec();
    forms.extend(RECIPE.to_le_bytes());
    forms.extend(count.to_le_bytes());
    for (leaf, column) in leaves.iter().zip(0..) {
        let x = i64::from(column * READY_SIZE_PX);
        imageops::replace(&mut sheet, &leaf.picture, x, 0);
        imageops::replace(&mut sheet, &leaf.surface, x, READY_SIZE_PX.into());
        forms.extend(leaf.season.to_le_bytes());
        // The finest level is left out: pictures of this size do not show it.
        for level in &leaf.form.levels[..2] {
            pack_level(level, &mut forms);
        }
    }
    let mut png = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Best, PngFilter::Adaptive);
    sheet.write_with_encoder(encoder).expect("memory takes every picture");
    ReadyFiles { sheet: png, forms }
}

fn pack_level(level: &FormLevel, bytes: &mut Vec<u8>) {
    let put = |value: usize, bytes: &mut Vec<u8>| {
        bytes.extend(u16::try_from(value).expect("meshes are small").to_le_bytes());
    };
    let place = |value: f32, bytes: &mut Vec<u8>| {
        let units = (value * UNITS + ZERO + 0.5).clamp(0.0, f32::from(u16::MAX));
        bytes.extend(u16::try_from(floor_i32(units)).expect("within 16 bits").to_le_bytes());
    };
    put(level.positions.len(), bytes);
    put(level.triangles.len(), bytes);
    put(level.shapes.len(), bytes);
    level.positions.iter().flatten().for_each(|value| place(*value, bytes));
    level.triangles.iter().flatten().for_each(|corner| put(*corner as usize, bytes));
    for shape in &level.shapes {
        bytes.extend(shape.water.to_le_bytes());
        shape.offsets.iter().flatten().for_each(|value| place(*value, bytes));
    }
}

/// Leaves of a sheet and its meshes; `None` if they are not of this format and recipe.
fn unpack(sheet: &[u8], forms: &[u8]) -> Option<Vec<ReadyLeaf>> {
    let sheet = image::load_from_memory_with_format(sheet, ImageFormat::Png).ok()?.into_rgba8();
    let mut bytes = Bytes(forms);
    if bytes.take()? != MAGIC || u32::from_le_bytes(bytes.take()?) != RECIPE {
        return None;
    }
    let count = u32::from_le_bytes(bytes.take()?);
    if sheet.dimensions() != (count * READY_SIZE_PX, 2 * READY_SIZE_PX) {
        return None;
    }
    let leaf = |column: u32| {
        let season = f32::from_le_bytes(bytes.take()?);
        let [coarse, fine] = [bytes.level()?, bytes.level()?];
        let tile = |row: u32| {
            let (x, y, side) = (column * READY_SIZE_PX, row * READY_SIZE_PX, READY_SIZE_PX);
            imageops::crop_imm(&sheet, x, y, side, side).to_image()
        };
        let form = LeafForm { levels: vec![coarse, fine.clone(), fine] };
        Some(ReadyLeaf { season, picture: tile(0), surface: tile(1), form })
    };
    (0..count).map(leaf).collect()
}

/// Bytes that are still to be read.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    fn count(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    fn places<const N: usize>(&mut self, count: u16) -> Option<Vec<[f32; N]>> {
        let place = |bytes: &mut Self| bytes.count().map(|units| (f32::from(units) - ZERO) / UNITS);
        (0..count)
            .map(|_| {
                let mut corner = [0.0; N];
                for value in &mut corner {
                    *value = place(self)?;
                }
                Some(corner)
            })
            .collect()
    }

    fn level(&mut self) -> Option<FormLevel> {
        let (corners, triangles, shapes) = (self.count()?, self.count()?, self.count()?);
        let positions = self.places(corners)?;
        let corner = |bytes: &mut Self| bytes.count().filter(|at| *at < corners).map(u32::from);
        let triangles = (0..triangles)
            .map(|_| Some([corner(self)?, corner(self)?, corner(self)?]))
            .collect::<Option<_>>()?;
        let shapes = (0..shapes)
            .map(|_| {
                let water = f32::from_le_bytes(self.take()?);
                Some(FormShape { water, offsets: self.places(corners)? })
            })
            .collect::<Option<_>>()?;
        Some(FormLevel { positions, triangles, shapes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_leaves_of_every_season() {
        for shape in Shape::ALL {
            let (sheet, forms) = embedded(shape);
            let leaves =
                ReadyLeaves::from_bytes(sheet, forms).expect("made by this recipe: run scripts/ready-leaves");
            assert_eq!(leaves.0.len(), SEASONS.len() * LEAVES as usize, "{shape:?}");
            for (season, nearest) in [((0.0, 0.0), 2), ((0.3, 0.7), 4), ((0.5, 0.5), 2), ((0.0, 1.0), 8)] {
                let layers = leaves.layers(season);
                assert_eq!(layers.len(), nearest, "{shape:?} in {season:?}");
                for layer in layers {
                    assert!((0.1..0.9).contains(&layer.area_fraction), "{shape:?}: {}", layer.area_fraction);
                    assert!(layer.form.levels.iter().all(|level| level.shapes.len() > 1), "{shape:?} dries");
                }
            }
        }
    }

    #[test]
    fn they_are_what_is_made_now() {
        // The leaf with the fewest veins is made in the shortest time.
        let made = ReadyFiles::make(Shape::Ginkgo).expect("it grows");
        let (sheet, forms) = embedded(Shape::Ginkgo);
        assert!(made.forms == forms, "other meshes: run scripts/ready-leaves");
        let pictures = |sheet: &[u8]| image::load_from_memory(sheet).expect("a picture").into_rgba8();
        assert!(pictures(&made.sheet) == pictures(sheet), "other pictures: run scripts/ready-leaves");
    }

    #[test]
    fn broken_files_are_refused() {
        let (sheet, forms) = embedded(Shape::Birch);
        assert!(unpack(&sheet[..100], forms).is_none(), "half a picture");
        for end in [0, 3, 8, 11, 40, forms.len() / 2, forms.len() - 1] {
            assert!(unpack(sheet, &forms[..end]).is_none(), "{end} bytes of meshes");
        }
        let mut other = forms.to_vec();
        other[4] ^= 1;
        assert!(unpack(sheet, &other).is_none(), "another recipe");
    }
}
