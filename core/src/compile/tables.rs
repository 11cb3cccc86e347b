// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes or reads the motion tables of the species and packs them for the kernels.

use std::panic::resume_unwind;

use crate::error::SceneError;
use crate::layout::Float4;
use crate::motion::table::{TABLE_ROWS, TABLES_PER_SPECIES};
use crate::motion::{MotionTables, Primitive};
use crate::scene::limits::MAX_PERIODS_PER_STEP;
use crate::scene::{Scene, Species};

/// Tables of every species, each made on a thread of its own.
pub(super) fn motions_of(scene: &Scene, seed: [u32; 2]) -> Result<Vec<MotionTables>, SceneError> {
    std::thread::scope(|scope| {
        let made: Vec<_> = scene
            .species
            .iter()
            .map(|species| scope.spawn(move || tables_of(scene, species, seed)))
            .collect();
        made.into_iter().map(|made| made.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}

/// Tables from a file or from the equations. The rates that the equations give have been validated with the scene;
/// those of a file are known only now.
fn tables_of(scene: &Scene, species: &Species, seed: [u32; 2]) -> Result<MotionTables, SceneError> {
    let Some(path) = &species.tables else {
        return Ok(MotionTables::generate(species, seed, scene.gravity_m_s2));
    };
    let text =
        std::fs::read_to_string(path).map_err(|source| SceneError::Read { path: path.into(), source })?;
    let tables = MotionTables::from_text(&text, path)?;
    let leaf = (1.0 + f64::from(species.speed_variation)) / (1.0 - f64::from(species.size_variation));
    let speedup = leaf * f64::from(scene.rotation_speed.max(1.0));
    let shortest = f64::from(scene.dt_s) * speedup / MAX_PERIODS_PER_STEP;
    for (primitive, table) in Primitive::ALL.iter().zip(&tables.0) {
        if table.period_s < shortest {
            return Err(SceneError::Field {
                file: path.clone(),
                field: format!("period_s of {}", primitive.code()),
                value: table.period_s.to_string(),
                allowed: format!("{shortest:.4} or more at dt_s {}, or a smaller dt_s", scene.dt_s),
            });
        }
    }
    Ok(tables)
}

/// Displacement and orientation rows of all tables, interleaved; behind them the velocity rows. Of the two quaternions
/// of a rotation each row takes the one nearer to the row before: a file may hold either, and rows are interpolated.
pub(super) fn pack_motion(tables: &[MotionTables]) -> Vec<Float4> {
    let rows = TABLE_ROWS as usize;
    let per_species = TABLES_PER_SPECIES as usize;
    let count = tables.len() * per_species;
    let mut packed = vec![Float4::default(); count * rows * 3];
    for (species, tables) in tables.iter().enumerate() {
        for (primitive, table) in tables.0.iter().enumerate() {
            let first = (species * per_species + primitive) * rows;
            let mut orientation = table.orientation[0];
            for row in 0..rows {
                let [x, y, z] = table.displacement_m[row];
                packed[2 * (first + row)] = Float4([x, y, z, 0.0]);
                let next = table.orientation[row];
                let cosine: f32 = orientation.iter().zip(next).map(|(a, b)| a * b).sum();
                orientation = if cosine < 0.0 { next.map(|part| -part) } else { next };
                packed[2 * (first + row) + 1] = Float4(orientation);
                let [x, y, z] = table.velocity_m[row];
                packed[2 * count * rows + first + row] = Float4([x, y, z, 0.0]);
            }
        }
    }
    packed
}
