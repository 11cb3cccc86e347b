// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hulls out of glTF files.

use std::path::Path;

use super::FlowError;
use super::hull::Hull;
use crate::scene::limits;
use crate::surface::Surface;
use crate::tree::gltf::read_triangles;

/// The hull in a file, scaled.
pub(super) fn read(file: &str, scale: f32) -> Result<Hull, FlowError> {
    let given =
        read_triangles(Path::new(file)).map_err(|source| FlowError::Gltf { source: Box::new(source) })?;
    let corners_m: Vec<[f32; 3]> = given.positions_m.iter().map(|at| at.map(|m| m * scale)).collect();
    let surface = Surface::new(&corners_m, &given.triangles)
        .map_err(|source| FlowError::Surface { file: file.into(), source })?;
    let [low_m, high_m] = surface.extent_m();
    let aside_m = low_m.abs().max(high_m.abs());
    let is_tall =
        (f64::from(limits::TREE_HEIGHT_M.low)..=limits::TREE_HEIGHT_M.high.into()).contains(&high_m.y);
    if low_m.y < 0.0 || !is_tall || aside_m.x.max(aside_m.z) > limits::HULL_RADIUS_M.high.into() {
        return Err(FlowError::Size { file: file.into(), low_m: low_m.y, high_m: high_m.y });
    }
    Ok(Hull::of_surface(&surface))
}
