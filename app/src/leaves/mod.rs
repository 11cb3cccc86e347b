// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf pictures of a scene: from folders that its species name, or made once and kept; until then small ones that come with the
//! program.

mod body;
mod cache;

pub(crate) use body::species_of_folder;
pub use body::{fit_bodies, load_scene};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use windfall_core::Scene;
use windfall_core::scene::{LeafShape, Species};
use windfall_render::MAX_LAYERS;
use windfall_texgen::{
    Assortment, Atlas, Layer, LeafFacts, LeafFolder, LeafPack, LightBody, PACK_SIZE_PX, Shape,
};

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
    let size_px = made_size(scene);
    let most = most_variants(scene);
    let make = |species: &Species, shape| {
        let folder = cache::load_or_make(&assortment(species, shape, size_px), progress)?;
        Ok(layers_of(&folder, species, size_px, most))
    };
    assembled(scene, size_px, &folders(scene)?, &make)
}

/// The pictures and meshes that a scene can be drawn with at once, and true if they are those of [`atlas_of`]: small leaves that come with
/// the program stand for those that would have to be made.
///
/// # Errors
/// A folder that a species names and that cannot be used.
pub fn atlas_at_once(scene: &Scene) -> anyhow::Result<(Atlas, bool)> {
    atlas_of_kept(scene, &cache::load)
}

/// The same with leaves that `kept` may have.
fn atlas_of_kept(
    scene: &Scene,
    kept: &dyn Fn(&Assortment) -> Option<LeafFolder>,
) -> anyhow::Result<(Atlas, bool)> {
    let size_px = made_size(scene);
    let most = most_variants(scene);
    // Before any leaf is unpacked, so that a folder that cannot be used is refused first.
    let mut folders = folders(scene)?;
    let mut is_complete = true;
    for (species, folder) in scene.species.iter().zip(&mut folders) {
        if let (None, Kind::Leaf(shape)) = (&folder, kind_of(species.shape)) {
            *folder = kept(&assortment(species, shape, size_px));
            is_complete &= folder.is_some();
        }
    }
    let size_px = if is_complete { size_px } else { PACK_SIZE_PX };
    let bundled = |species: &Species, shape| {
        let mut layers = LeafPack::bundled(shape).in_season(species.season);
        layers.truncate(most);
        Ok(layers)
    };
    Ok((assembled(scene, size_px, &folders, &bundled)?, is_complete))
}

/// Most pictures of each species of a scene.
fn most_variants(scene: &Scene) -> usize {
    MAX_LAYERS / scene.species.len().max(1)
}

/// Side of the pictures that are made for a scene.
fn made_size(scene: &Scene) -> u32 {
    let is_large = scene.species.len() * VARIANTS as usize <= LARGE_PICTURES;
    if is_large { PICTURE_SIZE } else { SMALL_SIZE }
}

/// The folder of each species that names one. They are read before any leaf is made, which takes long: so a folder that cannot be
/// used is refused at once.
fn folders(scene: &Scene) -> anyhow::Result<Vec<Option<LeafFolder>>> {
    let folder =
        |species: &Species| species.leaves.as_ref().map(|path| LeafFolder::load(path.as_ref())).transpose();
    Ok(scene.species.iter().map(folder).collect::<Result<_, _>>()?)
}

/// Layers of a folder's leaves that are in season.
fn layers_of(folder: &LeafFolder, species: &Species, size_px: u32, most: usize) -> Vec<Layer> {
    let leaves = in_season(&folder.leaves, species.season);
    leaves[..leaves.len().min(most)].par_iter().map(|leaf| Layer::of_leaf(leaf, size_px)).collect()
}

/// Pictures of all species; `leaves_of` has those of leaves without a folder.
fn assembled(
    scene: &Scene,
    size_px: u32,
    folders: &[Option<LeafFolder>],
    leaves_of: &dyn Fn(&Species, Shape) -> anyhow::Result<Vec<Layer>>,
) -> anyhow::Result<Atlas> {
    let most = most_variants(scene);
    let mut kinds: Vec<Vec<Layer>> = Vec::with_capacity(scene.species.len());
    for (species, folder) in scene.species.iter().zip(folders) {
        kinds.push(match (folder, kind_of(species.shape)) {
            (Some(folder), _) => layers_of(folder, species, size_px, most),
            (None, Kind::Leaf(shape)) => leaves_of(species, shape)?,
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
