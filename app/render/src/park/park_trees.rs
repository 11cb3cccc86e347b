// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Effects of the scene's own trees on the park around them: shade, litter.

use glam::Vec3;

use super::layout::TreeInstance;
use super::litter::Shedding;
use crate::trees::{SceneTrees, StandingTree};

/// Distance from the park's centre beyond which litter under trees is not seen, in metres.
const LITTER_REACH_M: f32 = 150.0;

/// The trees of a scene as those that hide the sky from the meadow and may strew litter on it.
pub(crate) fn own_trees(scene_trees: &SceneTrees, strew: bool) -> Vec<TreeInstance> {
    let tree = |tree: &StandingTree| TreeInstance {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        width: 1.0,
        kind: 0,
        turn_rad: 0.0,
        cut: 0.0,
        hue: 0.0,
        brightness: f32::from(u8::from(strew)),
    };
    scene_trees.trees.iter().filter(|tree| !tree.look.is_low).map(tree).collect()
}

/// All trees that have shed leaves before the scene begins.
pub(crate) fn shedding(planted: &[TreeInstance], center_m: Vec3, scene_trees: &SceneTrees) -> Vec<Shedding> {
    let far = planted.iter().filter(|tree| tree.foot_m.distance(center_m) < LITTER_REACH_M);
    let far = far.map(|tree| Shedding { foot_m: tree.foot_m, height_m: tree.height_m, species: None });
    let own = scene_trees.trees.iter().filter(|tree| !tree.look.is_low).map(|tree| Shedding {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        species: tree.species,
    });
    far.chain(own).collect()
}
