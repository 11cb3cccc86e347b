// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the scene's own trees mean for the park around them: shade, litter.

use super::layout::TreeInstance;
use super::litter::Shedding;
use crate::trees::{Stand, StandingTree};

/// The trees of a stand as those that hide the sky from the meadow and may strew litter on it.
pub(crate) fn own_trees(stand: &Stand, strew: bool) -> Vec<TreeInstance> {
    let tree = |tree: &StandingTree| TreeInstance {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        width: 1.0,
        sprite: 0,
        hue: 0.0,
        brightness: f32::from(u8::from(strew)),
    };
    stand.trees.iter().filter(|tree| !tree.look.is_low).map(tree).collect()
}

/// All trees that have shed leaves before the scene begins.
pub(crate) fn shedding(planted: &[TreeInstance], stand: &Stand) -> Vec<Shedding> {
    let far = planted.iter();
    let far = far.map(|tree| Shedding { foot_m: tree.foot_m, height_m: tree.height_m, species: None });
    let own = stand.trees.iter().filter(|tree| !tree.look.is_low).map(|tree| Shedding {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        species: tree.species,
    });
    far.chain(own).collect()
}
