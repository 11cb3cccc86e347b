// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that repeat without a seam, pictures included.

use windfall_core::{Cycle, Scene, SceneError, World};

use super::parse::option_error;

/// World that repeats after `seconds`; `file` names the scene.
///
/// # Errors
/// [`SceneError::Field`] for what cannot repeat, in the world or in its pictures: `--loop` for a length that is not allowed.
pub(crate) fn build_cycle(scene: &Scene, file: &str, seconds: f64) -> Result<(World, Cycle), SceneError> {
    let refuse = |field: &str, allowed: &str| {
        let (file, allowed) = (file.into(), format!("{allowed} in a loop"));
        Err(SceneError::Field { file, field: field.into(), value: "there".into(), allowed })
    };
    if scene.ground.water.is_some() {
        return refuse("ground.water", "no water, whose ripples never repeat,");
    }
    if !scene.view.path.is_empty() {
        return refuse("view.path", "a camera that stays");
    }
    World::build_cycle(scene, file, seconds).map_err(|error| option_error(error, Cycle::LENGTH, "--loop"))
}
