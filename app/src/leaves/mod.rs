// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf pictures of a scene: from folders that its species name, or made once and kept.

mod body;
mod cache;

pub use body::load_scene;
use image::{RgbaImage, imageops};
use windfall_core::Scene;
use windfall_core::scene::{LeafShape, Species};
use windfall_texgen::{Assortment, Atlas, Layer, LeafFacts, LeafFolder, LightBody, Shape};

use crate::render::MAX_LAYERS;

/// Pictures of each species.
const VARIANTS: u32 = 12;
/// Edge of a picture in texels.
const PICTURE_SIZE: u32 = 256;
/// Seed of the leaves that are made: the same for every scene, so that all find them ready.
const SEED: u64 = 0x1eaf;

/// The pictures for all species of a scene.
///
/// # Errors
/// A folder that a species names and that cannot be used. Leaves that are made cannot fail for want of a cache.
pub fn atlas_of(scene: &Scene) -> anyhow::Result<Atlas> {
    let most = MAX_LAYERS / scene.species.len().max(1);
    let mut folders = Vec::with_capacity(scene.species.len());
    for species in &scene.species {
        folders.push(match (&species.leaves, kind_of(species.shape)) {
            (Some(path), _) => pictures(&LeafFolder::load(path.as_ref())?, species.season),
            (None, Kind::Leaf(shape)) => {
                pictures(&cache::load_or_make(&assortment(species, shape))?, species.season)
            }
            (None, Kind::Other(body)) => painted(body)?,
        });
    }
    let variants = folders.iter().map(Vec::len).max().unwrap_or(1).clamp(1, most);
    let layers = folders
        .iter()
        .flat_map(|pictures| {
            (0..variants).map(|variant| Layer::from_picture(pictures[variant % pictures.len()].clone()))
        })
        .collect();
    Ok(Atlas { size_px: PICTURE_SIZE, variants: u32::try_from(variants)?, layers })
}

/// What draws a shape.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The leaf maker.
    Leaf(Shape),
    /// The quick painter of other light bodies.
    Other(LightBody),
}

fn kind_of(shape: LeafShape) -> Kind {
    match shape {
        LeafShape::Maple => Kind::Leaf(Shape::Maple),
        LeafShape::Oak => Kind::Leaf(Shape::Oak),
        LeafShape::Birch => Kind::Leaf(Shape::Birch),
        LeafShape::Beech => Kind::Leaf(Shape::Beech),
        LeafShape::Linden => Kind::Leaf(Shape::Linden),
        LeafShape::Ginkgo => Kind::Leaf(Shape::Ginkgo),
        LeafShape::JapaneseMaple => Kind::Leaf(Shape::JapaneseMaple),
        LeafShape::Hornbeam => Kind::Leaf(Shape::Hornbeam),
        LeafShape::Feather => Kind::Other(LightBody::Feather),
        LeafShape::Paper => Kind::Other(LightBody::Paper),
        LeafShape::Plate => Kind::Other(LightBody::Plate),
        LeafShape::Samara => Kind::Other(LightBody::Samara),
    }
}

/// What to make for a species without a folder.
fn assortment(species: &Species, shape: Shape) -> Assortment {
    Assortment { shape, season: species.season, count: VARIANTS, size_px: PICTURE_SIZE, seed: SEED }
}

/// Pictures of a body that is no leaf; they are painted in no time.
fn painted(body: LightBody) -> anyhow::Result<Vec<RgbaImage>> {
    let pictures = (0..u64::from(VARIANTS)).map(|variant| body.paint(PICTURE_SIZE, SEED + variant));
    Ok(pictures.collect::<Result<_, _>>()?)
}

/// The pictures of a folder that belong to a stretch of the season, in the size of the atlas.
fn pictures(folder: &LeafFolder, season: (f32, f32)) -> Vec<RgbaImage> {
    in_season(&folder.leaves, season).into_iter().map(|leaf| fitted(&leaf.maps.albedo)).collect()
}

/// The leaves that belong to a stretch of the season, all of them if none does.
fn in_season<L: AsRef<LeafFacts>>(leaves: &[L], (earliest, latest): (f32, f32)) -> Vec<&L> {
    let fits = |leaf: &&L| (earliest - 1e-3..=latest + 1e-3).contains(&leaf.as_ref().season);
    let chosen: Vec<&L> = leaves.iter().filter(fits).collect();
    if chosen.is_empty() { leaves.iter().collect() } else { chosen }
}

/// A picture in the size of the atlas.
fn fitted(picture: &RgbaImage) -> RgbaImage {
    let wanted = |level: &RgbaImage| level.width() == PICTURE_SIZE;
    if picture.width() < PICTURE_SIZE {
        return imageops::resize(picture, PICTURE_SIZE, PICTURE_SIZE, imageops::FilterType::Triangle);
    }
    // Halved step by step, colour weighted by coverage.
    let mips = Layer::from_picture(picture.clone()).mips;
    mips.into_iter().find(wanted).unwrap_or_else(|| picture.clone())
}

#[cfg(test)]
mod tests;
