// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Requests for leaf textures and the textures themselves.

use glam::Vec2;
use image::RgbaImage;

use crate::paint::{Leaf, paint};
use crate::rng::Rng;
use crate::{Shape, TexgenError, bleed, mipmap};

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasRequest {
    /// One entry a kind of leaf, 1 to 64.
    pub entries: Vec<AtlasEntry>,
    /// Leaves of each kind, 1 to 64.
    pub variants: u32,
    /// Side of each texture in texels, a power of two from 16 to 4096.
    pub size_px: u32,
    /// Seed; equal requests give equal bytes.
    pub seed: u64,
}

/// A kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasEntry {
    /// Outline family.
    pub shape: Shape,
    /// Earliest and latest season of the variants, each within 0 (green) to 1 (brown).
    pub season: (f32, f32),
}

/// Leaf textures, ready for an array texture.
#[derive(Clone, Debug)]
pub struct Atlas {
    /// Side of each texture in texels.
    pub size_px: u32,
    /// Leaves of each kind.
    pub variants: u32,
    /// All leaves: entry `e`, variant `v` is layer `e * variants + v`.
    pub layers: Vec<Layer>,
}

/// One leaf: upright, petiole at the bottom, straight alpha, sRGB colour that runs on past the edge.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Mip levels from full size down to one texel.
    pub mips: Vec<RgbaImage>,
    /// Share of the square that the leaf covers, petiole included.
    pub area_fraction: f32,
    /// Centre of the covered area: x to the right and y down, as shares of the square.
    pub centre: Vec2,
}

impl Default for AtlasRequest {
    /// Eight leaves of every shape in mid autumn at 256 texels.
    fn default() -> Self {
        let entries = Shape::ALL.map(|shape| AtlasEntry { shape, season: (0.35, 0.9) }).into();
        Self { entries, variants: 8, size_px: 256, seed: 1 }
    }
}

impl AtlasRequest {
    /// Checks every number.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for the first number that is not allowed.
    pub fn validate(&self) -> Result<(), TexgenError> {
        let count = self.entries.len();
        if !(1..=64).contains(&count) {
            return Err(TexgenError::out_of_range("entries.len()", count, "1 to 64"));
        }
        if !(1..=64).contains(&self.variants) {
            return Err(TexgenError::out_of_range("variants", self.variants, "1 to 64"));
        }
        if !self.size_px.is_power_of_two() || !(16..=4096).contains(&self.size_px) {
            return Err(TexgenError::out_of_range("size_px", self.size_px, "a power of two from 16 to 4096"));
        }
        for (index, entry) in self.entries.iter().enumerate() {
            let (earliest, latest) = entry.season;
            let field = |part: u8| format!("entries[{index}].season.{part}");
            if !(0.0..=1.0).contains(&earliest) {
                return Err(TexgenError::out_of_range(field(0), earliest, "0 to 1"));
            }
            if !(earliest..=1.0).contains(&latest) {
                return Err(TexgenError::out_of_range(field(1), latest, "the earliest season to 1"));
            }
        }
        Ok(())
    }
}

impl Atlas {
    /// Draws every leaf of a request.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] if a number of the request is not allowed.
    pub fn generate(request: &AtlasRequest) -> Result<Self, TexgenError> {
        request.validate()?;
        let seed = Rng::new(request.seed);
        let mut layers = Vec::new();
        for (index, entry) in request.entries.iter().enumerate() {
            let entry_seed = seed.fork(index as u64);
            let strata = shuffled(request.variants, &mut entry_seed.fork(u64::MAX));
            for (variant, stratum) in strata.into_iter().enumerate() {
                let rng = entry_seed.fork(variant as u64);
                let season = entry.season_of(stratum, request.variants, &mut rng.fork(0));
                layers.push(Layer::draw(entry.shape, season, request.size_px, &rng));
            }
        }
        Ok(Self { size_px: request.size_px, variants: request.variants, layers })
    }
}

impl AtlasEntry {
    /// Season of a variant: each has its own slice of the range and falls anywhere within it.
    fn season_of(&self, stratum: u32, variants: u32, rng: &mut Rng) -> f32 {
        let (earliest, latest) = self.season;
        let at = (stratum as f32 + rng.unit()) / variants as f32;
        (earliest + (latest - earliest) * at).clamp(earliest, latest)
    }
}

impl Layer {
    /// Draws one leaf.
    fn draw(shape: Shape, season: f32, size_px: u32, rng: &Rng) -> Self {
        let mut image = paint(&Leaf { shape, season, size_px }, rng);
        bleed::bleed(&mut image);
        let (mut covered, mut moment) = (0.0_f64, [0.0_f64; 2]);
        for (x, y, texel) in image.enumerate_pixels() {
            let alpha = f64::from(texel[3]) / 255.0;
            covered += alpha;
            moment[0] += alpha * (f64::from(x) + 0.5);
            moment[1] += alpha * (f64::from(y) + 0.5);
        }
        let side = f64::from(size_px);
        #[expect(clippy::cast_possible_truncation, reason = "shares of the square lose nothing that matters")]
        let share = |x: f64| x as f32;
        let centre = moment.map(|m| share(m / covered.max(1.0) / side));
        Self {
            mips: mipmap::chain(image),
            area_fraction: share(covered / (side * side)),
            centre: centre.into(),
        }
    }
}

/// 0 to `count` - 1 in random order, so that neighbouring layers differ in season.
fn shuffled(count: u32, rng: &mut Rng) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count).collect();
    for last in (1..order.len()).rev() {
        let other = rng.integer(0, u32::try_from(last).unwrap_or(u32::MAX)) as usize;
        order.swap(last, other);
    }
    order
}
