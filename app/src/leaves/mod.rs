// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf pictures of a scene: from folders that its species name, or made once and kept.

mod body;
mod cache;

pub(crate) use body::species_of_folder;
pub use body::{fit_bodies, load_scene};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use windfall_core::Scene;
use windfall_core::scene::{LeafShape, Species};
use windfall_render::MAX_LAYERS;
use windfall_texgen::{Assortment, Atlas, Layer, LeafFacts, LeafFolder, LightBody, Shape};

/// Pictures of each species.
const VARIANTS: u32 = 12;
/// Edge of a picture in texels.
const PICTURE_SIZE: u32 = 512;
/// Edge of a picture in a scene of so many pictures that large ones would take a gigabyte and more.
const SMALL_SIZE: u32 = 256;
/// Most large pictures.
const LARGE_PICTURES: usize = 192;
/// Seed of the leaves that are made: the same for every scene, so that all find them ready.
const SEED: u64 = 0x1eaf;

/// Called with how many leaves are made, of how many; several times for several species.
pub type LeafProgress = dyn Fn(u32, u32) + Sync;

/// Returns the pictures and meshes for all species of a scene.
///
/// # Errors
/// A folder that a species names and that cannot be used. Leaves that are made cannot fail for want of a cache.
pub fn atlas_of(scene: &Scene, progress: &LeafProgress) -> anyhow::Result<Atlas> {
    let most = MAX_LAYERS / scene.species.len().max(1);
    let is_large = scene.species.len() * VARIANTS as usize <= LARGE_PICTURES;
    let size_px = if is_large { PICTURE_SIZE } else { SMALL_SIZE };
    // Before any leaf is made, which takes long: so a folder that cannot be used is refused at once.
    let folders = scene
        .species
        .iter()
        .map(|species| species.leaves.as_ref().map(|path| LeafFolder::load(path.as_ref())).transpose());
    let folders = folders.collect::<Result<Vec<_>, _>>()?;
    let mut kinds: Vec<Vec<Layer>> = Vec::with_capacity(scene.species.len());
    for (species, folder) in scene.species.iter().zip(&folders) {
        let of_folder = |folder: &LeafFolder| {
            let leaves = in_season(&folder.leaves, species.season);
            leaves[..leaves.len().min(most)].par_iter().map(|leaf| Layer::of_leaf(leaf, size_px)).collect()
        };
        kinds.push(match (folder, kind_of(species.shape)) {
            (Some(folder), _) => of_folder(folder),
            (None, Kind::Leaf(shape)) => {
                of_folder(&cache::load_or_make(&assortment(species, shape, size_px), progress)?)
            }
            (None, Kind::Other(body)) => painted(body, size_px)?,
        });
    }
    let variants = kinds.iter().map(Vec::len).max().unwrap_or(1).clamp(1, most);
    let layers = kinds
        .iter()
        .flat_map(|layers| (0..variants).map(|variant| layers[variant % layers.len()].clone()))
        .collect();
    Ok(Atlas { size_px, variants: u32::try_from(variants)?, layers })
}

/// Maker of a shape's pictures.
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

/// Leaves to be made for a species without a folder.
fn assortment(species: &Species, shape: Shape, size_px: u32) -> Assortment {
    Assortment { shape, season: species.season, count: VARIANTS, size_px, seed: SEED }
}

/// A body that is no leaf; they are painted in no time.
fn painted(body: LightBody, size_px: u32) -> anyhow::Result<Vec<Layer>> {
    let pictures = (0..u64::from(VARIANTS)).map(|variant| body.paint(size_px, SEED + variant));
    Ok(pictures
        .map(|picture| Ok(Layer::from_picture(picture?)))
        .collect::<Result<_, windfall_texgen::TexgenError>>()?)
}

/// The leaves that belong to a stretch of the season, all of them if none does.
fn in_season<L: AsRef<LeafFacts>>(leaves: &[L], (earliest, latest): (f32, f32)) -> Vec<&L> {
    let fits = |leaf: &&L| (earliest - 1e-3..=latest + 1e-3).contains(&leaf.as_ref().season);
    let chosen: Vec<&L> = leaves.iter().filter(fits).collect();
    if chosen.is_empty() { leaves.iter().collect() } else { chosen }
}

#[cfg(test)]
mod tests;
