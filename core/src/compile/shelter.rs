// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles shelter.

use super::foliage::leaves_left;
use super::foot_height;
use crate::blocks::SceneBlock;
use crate::convert::single;
use crate::layout::Uint4;
use crate::scene::{Profile, Scene};
use crate::solid::Solid;
use crate::tree::Forest;
use crate::wind::{ShelterGrids, ShelterWind};

/// Rows of the shelter tables; the tables hold the hills.
pub(super) fn shelter_rows(
    grids: &ShelterGrids,
    scene: &Scene,
    solids: &[Solid],
    forest: &Forest,
    block: &SceneBlock,
    tables: &[Uint4],
) -> Vec<Uint4> {
    grids.rows(scene, solids, forest, &shelter_wind(scene), |x_m, z_m| {
        foot_height(block, tables, single(x_m), single(z_m)).into()
    })
}

/// The wind that a scene's shelter is made for.
pub(super) fn shelter_wind(scene: &Scene) -> ShelterWind {
    let (sin, cos) = libm::sincos(f64::from(scene.wind.direction_deg).to_radians());
    let leaves_left = leaves_left(f64::from(scene.autumn));
    let roughness_m = scene.ground.surface_roughness_m.into();
    ShelterWind { direction_x: cos, direction_z: sin, leaves_left, roughness_m }
}

/// Numbers that these rows depend on and that may change while a simulation runs.
pub(super) fn shelter_inputs(scene: &Scene) -> [f32; 4] {
    [scene.wind.direction_deg, scene.autumn, scene.ground.height_m, scene.ground.surface_roughness_m]
}

/// Returns true if shelter takes part in the wind: where it is asked for, where anything lacks wind, and where the wind has a ground.
pub(super) fn is_sheltered(scene: &Scene, rows: &[Uint4]) -> bool {
    let lacks = |row: &Uint4| row.0 != [0; 4];
    scene.wind.shelter && scene.wind.profile != Profile::Uniform && rows.iter().any(lacks)
}
