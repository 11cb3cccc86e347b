// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums over the snow of a world: in the air, on branches, on the ground, and what has melted.

use serde::Serialize;

use super::Bed;
use crate::blocks::SceneBlock;
use crate::device::terrain::snow::{SNOW_DEPTH_M, SNOW_UNIT_KG, SNOW_WATER_MM};
use crate::scene::Scene;

/// Kilograms of a unit of water.
const UNIT_KG: f64 = SNOW_UNIT_KG as f64;

/// Sums over the snow of a world at one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SnowStats {
    /// Flakes in the air.
    pub flakes: u32,
    /// Water in the air in kg, with what crowns have just caught and what falls from them.
    pub falling_kg: f64,
    /// Water of the snow on the branches of trees in kg.
    pub on_branches_kg: f64,
    /// Water that has landed on the ground of the rectangle since time zero, and that lay there then, in kg.
    pub landed_kg: f64,
    /// Water of the snow that lies in kg.
    pub lying_kg: f64,
    /// The same over the rectangle in mm.
    pub lying_mm: f64,
    /// Water that has melted in kg.
    pub melted_kg: f64,
    /// The same over the rectangle in mm.
    pub melted_mm: f64,
    /// Greatest depth in m.
    pub deepest_m: f64,
    /// Depth on average over the rectangle in m.
    pub mean_depth_m: f64,
    /// Share of the rectangle under at least a tenth of a millimetre of water.
    pub covered: f64,
}

impl SnowStats {
    /// Sums over a bed under flakes of which so many are in the air; `None` without snow.
    pub(crate) fn of(scene: &Scene, block: &SceneBlock, bed: &Bed, flakes: u32, step: u32) -> Option<Self> {
        scene.weather.as_ref()?;
        let snow = bed.snow(block);
        let sum = |words: &[u32]| words.iter().copied().map(u64::from).sum::<u64>() as f64;
        let count = snow.water.len() as f64;
        let water = sum(snow.water);
        let covered = snow.water.iter().filter(|water| f64::from(**water) * f64::from(SNOW_WATER_MM) >= 0.1);
        Some(Self {
            flakes,
            falling_kg: (f64::from(flakes) * f64::from(block.snow.flake_water)
                + sum(bed.in_crowns(block, step))
                + sum(bed.branch_falls(block)))
                * UNIT_KG,
            on_branches_kg: sum(bed.branch_snow(block)) * UNIT_KG,
            landed_kg: sum(snow.landed) * UNIT_KG,
            lying_kg: water * UNIT_KG,
            lying_mm: water * f64::from(SNOW_WATER_MM) / count,
            melted_kg: sum(snow.melted) * UNIT_KG,
            melted_mm: sum(snow.melted) * f64::from(SNOW_WATER_MM) / count,
            deepest_m: f64::from(snow.depth.iter().copied().max().unwrap_or(0)) * f64::from(SNOW_DEPTH_M),
            mean_depth_m: sum(snow.depth) * f64::from(SNOW_DEPTH_M) / count,
            covered: covered.count() as f64 / count,
        })
    }
}
