// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes or reads the motion tables of the species and packs them for the kernels.

use super::species::cone_spiral;
use crate::device::motion::lookup::{LARGEST_HALF, PAIR_WEIGHT};
use crate::error::SceneError;
use crate::layout::Uint4;
use crate::motion::table::{TABLE_ROWS, TABLES_PER_SPECIES};
use crate::motion::{MotionTables, Primitive};
use crate::scene::limits::MAX_PERIODS_PER_STEP;
use crate::scene::{Scene, Species};
use crate::threads::each;

/// Tables of every species, each made on a thread of its own.
pub(super) fn motions_of(scene: &Scene, seed: [u32; 2]) -> Result<Vec<MotionTables>, SceneError> {
    each(scene.species.iter(), |species| tables_of(scene, species, seed)).into_iter().collect()
}

/// Tables from a file or from the equations. The rates that the equations give have been validated with the scene;
/// those of a file are known only now.
fn tables_of(scene: &Scene, species: &Species, seed: [u32; 2]) -> Result<MotionTables, SceneError> {
    let Some(path) = &species.tables else {
        return Ok(MotionTables::generate(species, seed, scene.gravity_m_s2));
    };
    let tables = MotionTables::read(path)?;
    let leaf = (1.0 + f64::from(species.speed_variation)) / (1.0 - f64::from(species.size_variation));
    let speedup = leaf * f64::from(scene.rotation_speed.max(1.0));
    let shortest = f64::from(scene.dt_s) * speedup / MAX_PERIODS_PER_STEP;
    for (primitive, table) in Primitive::JOINED.iter().zip(&tables.0) {
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

/// Displacement and orientation rows of all tables, interleaved, in pairs of 16 bits (see
/// [`MotionRows`](crate::device::motion::lookup::MotionRows)); behind them the velocity rows. There is room for the tables of all that counts like species: bodies, which need none,
/// are looked up beside others.
pub(super) fn pack_motion(scene: &Scene, tables: &[MotionTables], table_species: u32) -> Vec<Uint4> {
    let rows = TABLE_ROWS as usize;
    let per_species = TABLES_PER_SPECIES as usize;
    let count = table_species as usize * per_species;
    let mut packed = vec![Uint4::default(); count * rows * 3];
    for (species, tables) in tables.iter().enumerate() {
        let wound = cone_spiral(scene, &scene.species[species]).map(|spiral| spiral.table());
        let wound = wound.iter().map(|table| (Primitive::ConeSpiral as usize, table));
        for (primitive, table) in tables.0.iter().enumerate().chain(wound) {
            let first = (species * per_species + primitive) * rows;
            let unit = displacement_unit(&table.displacement_m);
            let turns = consistent_signs(&table.orientation);
            for row in 0..rows {
                let next = (row + 1).min(rows - 1);
                let [x, y, z] = pairs(table.displacement_m[row], table.displacement_m[next], unit);
                let weighted = (unit / PAIR_WEIGHT as f32).to_bits();
                packed[2 * (first + row)] = Uint4([x, y, z, weighted]);
                packed[2 * (first + row) + 1] = Uint4(pairs(turns[row], turns[next], 1.0 / LARGEST_HALF));
                let [x, y, z] = table.velocity_m[row].map(f32::to_bits);
                packed[2 * count * rows + first + row] = Uint4([x, y, z, 0]);
            }
        }
    }
    packed
}

/// Unit in metres in which all displacements of a table fit 16 bits.
fn displacement_unit(displacements: &[[f32; 3]]) -> f32 {
    displacements.as_flattened().iter().fold(0f32, |most, part| most.max(part.abs())) / LARGEST_HALF
}

/// Of the two quaternions of a rotation those nearer to the rows before: a file may hold either, and rows are interpolated.
fn consistent_signs(turns: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let mut before = turns[0];
    turns
        .iter()
        .map(|turn| {
            let cosine: f32 = before.iter().zip(turn).map(|(a, b)| a * b).sum();
            before = if cosine < 0.0 { turn.map(|part| -part) } else { *turn };
            before
        })
        .collect()
}

/// Numbers of a row and of the next one in that unit, each two in the halves of a word.
fn pairs<const N: usize>(this: [f32; N], next: [f32; N], unit: f32) -> [u32; N] {
    let half = |number: f32| {
        let units = if unit > 0.0 { libm::roundf(number / unit) } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most LARGEST_HALF")]
        let half = units as i16 as u16;
        u32::from(half)
    };
    std::array::from_fn(|part| half(this[part]) | (half(next[part]) << 16))
}
