// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Input of a renderer.

use windfall_core::blocks::BurnBlock;
use windfall_core::scene::Release;
use windfall_core::solid::Solid;
use windfall_core::{CompiledScene, Scene};
use windfall_texgen::Atlas;

use crate::park::litter::BedRim;
use crate::quality::Quality;
use crate::trees::SceneTrees;

/// Leaves of litter on a meadow in autumn.
const LITTER: u32 = 14_000;

/// Most pixels drawn at once by default: 4K UHD, whose multisampled targets take 400 MB.
const TILE_PX: u32 = 3840 * 2160;

/// Choices of a renderer that are no part of a scene.
#[derive(Clone, Copy, Debug)]
pub struct RendererOptions {
    /// Leaves strewn over the meadow before the scene begins, not simulated: 0 to 100000.
    pub litter_count: u32,
    /// Most pixels of a picture that are drawn at once, at least 1: larger pictures are drawn by tiles.
    pub tile_px: u32,
    /// Effort spent on the pictures.
    pub quality: Quality,
}

impl RendererOptions {
    /// A scene that has been going on since before time zero has leaves on its ground; one that only begins then has a
    /// clean one, on which its own leaves and their trails show. A bed of living litter goes on beyond its rim.
    pub fn for_scene(scene: &Scene) -> Self {
        let began = |release| matches!(release, Release::Rate { from_s, .. } if from_s < 0.0);
        let has_past = scene.sources.iter().any(|source| began(source.release));
        // In summer there is none under the trees of a scene.
        let season = if scene.trees.is_empty() { 1.0 } else { (2.0 * scene.autumn).min(1.0) };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a small number"
        )]
        let litter_count = (season * LITTER as f32) as u32;
        let litter_count = if has_past { litter_count } else { 0 };
        let fringe_count = BedRim::of(scene).map_or(0, |bed| bed.fringe_count());
        let is_strewn = scene.view.trail_s == 0.0;
        let litter_count = if is_strewn { litter_count + fringe_count } else { 0 };
        Self { litter_count, tile_px: TILE_PX, quality: Quality::Full }
    }
}

/// Scene, trees and leaf pictures that a renderer draws.
#[derive(Clone, Copy, Debug)]
pub struct RenderScene<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The solid parts of its compiled scene.
    pub solids: &'a [Solid],
    /// Burning of its species, of its compiled scene's block.
    pub burns: &'a [BurnBlock],
    /// Its compiled scene, where snow may lie.
    pub snow: Option<&'a CompiledScene>,
    /// Its trees.
    pub trees: &'a SceneTrees,
    /// The pictures of its species' leaves.
    pub atlas: &'a Atlas,
}

impl<'a> RenderScene<'a> {
    /// A scene with what it compiles to, its trees and the pictures of its species' leaves.
    pub fn of(
        scene: &'a Scene,
        compiled: &'a CompiledScene,
        trees: &'a SceneTrees,
        atlas: &'a Atlas,
    ) -> Self {
        let (solids, burns) = (compiled.solids(), &compiled.block().burns);
        let snow = compiled.block().has_snow().then_some(compiled);
        Self { scene, solids, burns, snow, trees, atlas }
    }
}
