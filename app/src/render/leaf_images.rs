// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pictures of leaves the renderer cuts its leaves from.

use image::RgbaImage;

use super::RenderError;

/// Most layers whose blade areas fit the renderer's uniform block.
pub const MAX_LAYERS: usize = 512;

/// One leaf: an upright sRGB picture with straight alpha, petiole at the bottom, and its smaller copies.
#[derive(Clone, Debug)]
pub struct LeafImage {
    /// The picture and its halvings, largest first.
    pub mips: Vec<RgbaImage>,
    /// Part of the square that the blade covers, 0 to 1.
    pub area_fraction: f32,
}

/// Pictures of every species: layer `(species * stages + stage) * variants + variant`.
#[derive(Clone, Debug)]
pub struct LeafImages {
    /// Edge of the largest pictures in pixels.
    pub size_px: u32,
    /// Pictures per species and stage of the season.
    pub variants: u32,
    /// Stages of the season per species, from the species' first to its last; a leaf's tint picks one.
    pub stages: u32,
    /// The pictures.
    pub layers: Vec<LeafImage>,
}

impl LeafImages {
    /// Checks that the pictures belong together and cover `species_count` species.
    pub(super) fn check(&self, species_count: usize, layer_limit: u32) -> Result<(), RenderError> {
        let wanted = species_count * self.stages as usize * self.variants as usize;
        if wanted == 0 || self.layers.len() != wanted {
            return Err(RenderError::Images(format!(
                "{} pictures for {species_count} species, {} stages and {} variants",
                self.layers.len(),
                self.stages,
                self.variants
            )));
        }
        let limit = layer_limit.min(u32::try_from(MAX_LAYERS).unwrap_or(u32::MAX));
        if self.layers.len() > limit as usize {
            return Err(RenderError::Layers { layers: self.layers.len(), limit });
        }
        let mip_count = self.layers[0].mips.len();
        for (index, layer) in self.layers.iter().enumerate() {
            let sizes_fit = layer.mips.iter().enumerate().all(|(level, mip)| {
                let edge = (self.size_px >> level).max(1);
                mip.dimensions() == (edge, edge)
            });
            if mip_count == 0 || layer.mips.len() != mip_count || !sizes_fit {
                return Err(RenderError::Images(format!("picture {index} has unexpected sizes")));
            }
            if !(layer.area_fraction > 0.0 && layer.area_fraction <= 1.0) {
                return Err(RenderError::Images(format!(
                    "picture {index} covers {} of its square; allowed: 0 to 1",
                    layer.area_fraction
                )));
            }
        }
        Ok(())
    }
}
