// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Passes of a frame that are timed, and the parts of the scene.

use crate::lens::post::TimedPosts;

/// Passes that are timed, in order of drawing: the scene as a whole or in its parts.
pub(super) const TIMED_PASSES: [&str; 17] = [
    "particle order",
    "shadows",
    "shafts",
    "scene",
    "objects",
    "leaves",
    "bark",
    "grass",
    "ground",
    "far trees",
    "sky",
    "particles",
    "shutter",
    "focus",
    "exposure",
    "glare",
    "tone map",
];
/// Numbers of the shafts of light, of the whole scene, and of the first of its parts among them.
pub(super) const TIMED_SHAFTS: u32 = 2;
pub(super) const TIMED_SCENE: u32 = 3;
pub(super) const TIMED_PARTS: u32 = 4;
/// Numbers of those after the scene.
pub(super) const TIMED_POSTS: TimedPosts =
    TimedPosts { shutter: 12, focus: 13, exposure: 14, glare: 15, tone_map: 16 };

/// Parts of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) enum ScenePart {
    /// Trunks and limbs of the scene's own trees.
    Bark,
    Objects,
    /// All leaves, fruit and blobs.
    Leaves,
    Grass,
    /// Ground, snow on it, and water.
    Ground,
    FarTrees,
    Sky,
    /// Particles, and marks over the picture.
    Particles,
}

impl ScenePart {
    /// All, in order of drawing: near things first, so that what they hide is not shaded.
    pub(super) const ALL: [Self; 8] = [
        Self::Objects,
        Self::Leaves,
        Self::Bark,
        Self::Grass,
        Self::Ground,
        Self::FarTrees,
        Self::Sky,
        Self::Particles,
    ];
}

/// The parts, each by itself, in the order of their names.
pub(super) const SCENE_PARTS: [&[ScenePart]; ScenePart::ALL.len()] = [
    &[ScenePart::Objects],
    &[ScenePart::Leaves],
    &[ScenePart::Bark],
    &[ScenePart::Grass],
    &[ScenePart::Ground],
    &[ScenePart::FarTrees],
    &[ScenePart::Sky],
    &[ScenePart::Particles],
];
