// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that are compiled in a fraction of a second. Large ones are allowed and take their time, which says nothing of a reader.

use windfall_core::Scene;

/// Most leaves, those of trees and those that lie included, and most particles.
const MOST_ROWS: u32 = 2000;
/// Most trees, and most objects and walkers.
const MOST_THINGS: usize = 3;

/// True for a scene that is cheap to compile and names no file.
pub fn is_cheap(scene: &Scene) -> bool {
    scene.leaf_count() <= MOST_ROWS
        && scene.particle_count() <= MOST_ROWS
        && scene.trees.len() <= MOST_THINGS
        && scene.objects.len() + scene.walkers.len() <= MOST_THINGS
        && scene.files().is_empty()
}

/// True for a text that is such a scene or none at all.
pub fn is_cheap_text(text: &str) -> bool {
    Scene::from_ron(text, "a scene").map_or(true, |scene| is_cheap(&scene))
}
