// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of leaves: those bundled with Windfall, of the species and seasons of a scene, side by side in one texture.

use std::ops::Range;

use bevy::asset::RenderAssetUsages;
use bevy::image::ImageSampler;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use bytemuck::{Pod, Zeroable};
use windfall_core::Scene;
use windfall_core::flight::mass::MassDistribution;
use windfall_core::scene::{LeafShape, Species};
use windfall_texgen::{Layer, LeafPack, LightBody, PACK_SIZE_PX, Shape};

/// Pictures of a species that is no leaf.
const PAINTED: u64 = 4;
/// Mip levels: down to four texels a side, so that neighbours do not run into each other.
const LEVELS: u32 = PACK_SIZE_PX.ilog2() - 1;

/// A picture, as the vertex shader reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct PictureRow {
    /// First corner in the texture, 0 to 1.
    origin: [f32; 2],
    /// Sides in the texture, 0 to 1.
    sides: [f32; 2],
    /// Middle of the covered area, in sides of the picture.
    middle: [f32; 2],
    /// The same from the centre of mass, along x and z, in metres.
    offset_m: [f32; 2],
    /// Side of the picture on a leaf of nominal size, in metres.
    edge_m: f32,
    /// Share of a dry leaf's folds, 0 to 1.
    folds: f32,
}

/// Pictures of all species of a scene.
#[derive(Debug)]
pub(crate) struct Pictures {
    pub(crate) image: Image,
    pub(crate) rows: Vec<PictureRow>,
    /// Rows of each species.
    pub(crate) of_species: Vec<Range<u32>>,
}

impl Pictures {
    /// Unpacks the pictures that a scene needs.
    pub(crate) fn of(scene: &Scene) -> Self {
        let (mut layers, mut owners, mut of_species) = (Vec::new(), Vec::new(), Vec::new());
        for species in &scene.species {
            let first = count(&layers);
            layers.extend(layers_of(species));
            owners.resize(layers.len(), species);
            of_species.push(first..count(&layers));
        }
        let columns = count(&layers).isqrt().max(1);
        let grid = UVec2::new(columns, count(&layers).div_ceil(columns).max(1));
        let rows = layers.iter().zip(&owners).zip(0..);
        let rows = rows.map(|((layer, species), number)| PictureRow::of(layer, species, number, grid));
        Self { rows: rows.collect(), image: image(&layers, grid), of_species }
    }
}

impl PictureRow {
    fn of(layer: &Layer, species: &Species, number: u32, grid: UVec2) -> Self {
        let texel = (PACK_SIZE_PX as f32).recip();
        let cell = UVec2::new(number % grid.x, number / grid.x).as_vec2();
        let mass = MassDistribution::of(species).centre;
        #[expect(clippy::cast_possible_truncation, reason = "shares of a radius")]
        let offset_m = [mass.x, mass.z].map(|share| -0.5 * share as f32 * species.size_m);
        Self {
            // Half a texel is left out all round.
            origin: ((cell + 0.5 * texel) / grid.as_vec2()).to_array(),
            sides: (Vec2::splat(1.0 - texel) / grid.as_vec2()).to_array(),
            middle: [layer.centre.x, layer.centre.y],
            offset_m,
            // pi / 4 d^2 = area fraction * edge^2
            edge_m: species.size_m * (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt(),
            folds: match species.shape {
                LeafShape::Plate => 0.0,
                LeafShape::Samara => 0.2,
                LeafShape::Paper => 0.5,
                _ => 1.0,
            },
        }
    }
}

fn count(layers: &[Layer]) -> u32 {
    u32::try_from(layers.len()).expect("at most some hundreds of pictures")
}

/// Pictures of a species in its season.
fn layers_of(species: &Species) -> Vec<Layer> {
    let leaf = |shape| LeafPack::bundled(shape).in_season(species.season);
    let other = |body: LightBody| {
        let paint =
            |seed| body.paint(PACK_SIZE_PX, seed).expect("the size of packs is one that painters take");
        (0..PAINTED).map(|seed| Layer::from_picture(paint(seed))).collect()
    };
    match species.shape {
        LeafShape::Maple => leaf(Shape::Maple),
        LeafShape::Oak => leaf(Shape::Oak),
        LeafShape::Birch => leaf(Shape::Birch),
        LeafShape::Beech => leaf(Shape::Beech),
        LeafShape::Linden => leaf(Shape::Linden),
        LeafShape::Ginkgo => leaf(Shape::Ginkgo),
        LeafShape::JapaneseMaple => leaf(Shape::JapaneseMaple),
        LeafShape::Hornbeam => leaf(Shape::Hornbeam),
        LeafShape::Feather => other(LightBody::Feather),
        LeafShape::Paper => other(LightBody::Paper),
        LeafShape::Plate => other(LightBody::Plate),
        LeafShape::Samara => other(LightBody::Samara),
    }
}

/// One texture of all pictures with their mips, row by row of a grid.
fn image(layers: &[Layer], grid: UVec2) -> Image {
    let mut texels = Vec::new();
    for level in 0..LEVELS {
        let side = (PACK_SIZE_PX >> level) as usize;
        let stride = 4 * side * grid.x as usize;
        let first = texels.len();
        texels.resize(first + stride * side * grid.y as usize, 0);
        for (number, layer) in layers.iter().enumerate() {
            let (column, row) = (number % grid.x as usize, number / grid.x as usize);
            for (y, line) in layer.mips[level as usize].as_raw().chunks_exact(4 * side).enumerate() {
                let at = first + (row * side + y) * stride + column * 4 * side;
                texels[at..at + line.len()].copy_from_slice(line);
            }
        }
    }
    let size =
        Extent3d { width: PACK_SIZE_PX * grid.x, height: PACK_SIZE_PX * grid.y, depth_or_array_layers: 1 };
    let mut image = Image::new_uninit(
        size,
        TextureDimension::D2,
        TextureFormat::Rgba8UnormSrgb,
        RenderAssetUsages::RENDER_WORLD,
    );
    image.texture_descriptor.mip_level_count = LEVELS;
    image.data = Some(texels);
    image.sampler = ImageSampler::linear();
    image
}
