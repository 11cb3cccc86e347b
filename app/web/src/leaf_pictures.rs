// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of a scene's species, from the packs that the page has fetched.

use std::collections::BTreeMap;

use image::{Rgba, RgbaImage};
use windfall_core::Scene;
use windfall_core::scene::LeafShape;
use windfall_render::MAX_LAYERS;
use windfall_texgen::{Atlas, Layer, LeafPack, LightBody, PACK_SIZE_PX, Shape};

use crate::error::WebError;

/// Pictures of a body that is no leaf.
const PAINTED: u64 = 8;
/// Edge and colour of a leaf whose pack is missing: a brown ellipse.
const PLAIN: Rgba<u8> = Rgba([150, 96, 40, 255]);

/// Packs by the name of their shape.
#[derive(Debug, Default)]
pub(crate) struct LeafPictures {
    packs: BTreeMap<String, LeafPack>,
}

/// Painter of a shape's pictures.
enum Painter {
    /// The leaf maker, by way of a pack.
    Pack(Shape),
    /// The quick painter of other light bodies.
    Light(LightBody),
}

fn painter(shape: LeafShape) -> Painter {
    match shape {
        LeafShape::Maple => Painter::Pack(Shape::Maple),
        LeafShape::Oak => Painter::Pack(Shape::Oak),
        LeafShape::Birch => Painter::Pack(Shape::Birch),
        LeafShape::Beech => Painter::Pack(Shape::Beech),
        LeafShape::Linden => Painter::Pack(Shape::Linden),
        LeafShape::Ginkgo => Painter::Pack(Shape::Ginkgo),
        LeafShape::JapaneseMaple => Painter::Pack(Shape::JapaneseMaple),
        LeafShape::Hornbeam => Painter::Pack(Shape::Hornbeam),
        LeafShape::Feather => Painter::Light(LightBody::Feather),
        LeafShape::Paper => Painter::Light(LightBody::Paper),
        LeafShape::Plate => Painter::Light(LightBody::Plate),
        LeafShape::Samara => Painter::Light(LightBody::Samara),
    }
}

/// Names of all packs, with their shapes.
pub(crate) const PACKS: [(&str, Shape); 8] = [
    ("maple", Shape::Maple),
    ("oak", Shape::Oak),
    ("birch", Shape::Birch),
    ("beech", Shape::Beech),
    ("linden", Shape::Linden),
    ("ginkgo", Shape::Ginkgo),
    ("japanese-maple", Shape::JapaneseMaple),
    ("hornbeam", Shape::Hornbeam),
];

fn pack_name(shape: Shape) -> &'static str {
    PACKS.iter().find(|(_, one)| *one == shape).map_or("maple", |(name, _)| *name)
}

/// Names of the packs that a scene needs.
pub(crate) fn wanted(scene: &Scene) -> Vec<&'static str> {
    let mut names: Vec<_> = scene
        .species
        .iter()
        .filter_map(|species| match painter(species.shape) {
            Painter::Pack(shape) => Some(pack_name(shape)),
            Painter::Light(_) => None,
        })
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

impl LeafPictures {
    /// Takes over the bytes of a pack.
    ///
    /// # Errors
    /// [`WebError::LeafPack`] for bytes that are no pack.
    pub(crate) fn give(&mut self, name: &str, bytes: &[u8]) -> Result<(), WebError> {
        let broken = |error| WebError::LeafPack { file: name.to_owned(), error };
        self.packs.insert(name.to_owned(), LeafPack::from_bytes(bytes).map_err(broken)?);
        Ok(())
    }

    /// Pictures and meshes for all species of a scene; a species whose pack is missing has a plain one.
    ///
    /// # Errors
    /// Errors of the painter of light bodies.
    pub(crate) fn atlas_of(&self, scene: &Scene) -> Result<Atlas, WebError> {
        let most = MAX_LAYERS / scene.species.len().max(1);
        let mut kinds: Vec<Vec<Layer>> = Vec::with_capacity(scene.species.len());
        for species in &scene.species {
            let layers = match painter(species.shape) {
                Painter::Pack(shape) => {
                    let pack = self.packs.get(pack_name(shape));
                    pack.map_or_else(|| vec![plain()], |pack| pack.in_season(species.season))
                }
                Painter::Light(body) => {
                    let pictures =
                        (0..PAINTED).map(|seed| body.paint(PACK_SIZE_PX, seed).map(Layer::from_picture));
                    pictures.collect::<Result<_, _>>()?
                }
            };
            kinds.push(layers);
        }
        let variants = kinds.iter().map(Vec::len).max().unwrap_or(1).clamp(1, most);
        let layers = kinds
            .iter()
            .flat_map(|layers| (0..variants).map(|variant| layers[variant % layers.len()].clone()))
            .collect();
        let variants = u32::try_from(variants).expect("at most as many as there are layers");
        Ok(Atlas { size_px: PACK_SIZE_PX, variants, layers })
    }
}

/// A brown ellipse.
fn plain() -> Layer {
    let middle = 0.5 * PACK_SIZE_PX as f32;
    Layer::from_picture(RgbaImage::from_fn(PACK_SIZE_PX, PACK_SIZE_PX, |x, y| {
        let (right, down) =
            ((x as f32 + 0.5 - middle) / (0.6 * middle), (y as f32 + 0.5 - middle) / (0.95 * middle));
        let Rgba([r, g, b, _]) = PLAIN;
        Rgba([r, g, b, if right * right + down * down < 1.0 { u8::MAX } else { 0 }])
    }))
}
