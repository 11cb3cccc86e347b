// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counts and sums over the litter of a world.

use super::Bed;
use crate::blocks::LitterBlock;
use crate::device::leaf::record::{flies, is_afloat, is_held, is_sunk, leaf_species, lies, size_ratio};
use crate::device::terrain::litter::{LITTER_CELLS_PER_M, LITTER_UNIT_M};
use crate::leaf::Leaves;
use crate::scene::Scene;

/// Counts and sums over the litter of a world at one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LitterStats {
    /// Leaves that lie in the litter.
    pub lying: u32,
    /// Leaves that lie on solid things.
    pub held: u32,
    /// Leaves that float on water.
    pub afloat: u32,
    /// Leaves that sink in water or lie under it.
    pub sunk: u32,
    /// Leaves that move as bodies, in the air or on the ground.
    pub awake: u32,
    /// Leaves that the wind has taken from the litter since time zero, each time that it did.
    pub woken: u32,
    /// Greatest height of litter in m.
    pub deepest_m: f64,
    /// Volume of the litter, and of what floats, in m³.
    pub volume_m3: f64,
    /// Mass of the leaves that lie in kg, with their water.
    pub mass_kg: f64,
}

impl LitterStats {
    /// Statistics of leaves and their bed; `None` without litter.
    pub(crate) fn of(scene: &Scene, block: &LitterBlock, leaves: &Leaves, bed: &Bed) -> Option<Self> {
        let litter = scene.ground.litter?;
        let heights = bed.heights(block);
        let cell_m = 1.0 / f64::from(LITTER_CELLS_PER_M);
        let mut stats = Self { woken: bed.woken(block), ..Self::default() };
        stats.deepest_m = f64::from(heights.iter().copied().max().unwrap_or(0)) * f64::from(LITTER_UNIT_M);
        let sum: u64 = heights.iter().copied().map(u64::from).sum();
        stats.volume_m3 = sum as f64 * f64::from(LITTER_UNIT_M) * cell_m * cell_m;
        for (place, schedule) in leaves.place.iter().zip(&leaves.schedule) {
            stats.awake += u32::from(flies(place.bits));
            if !lies(place.bits) {
                continue;
            }
            if is_held(place.bits) {
                stats.held += 1;
            } else if is_afloat(place.bits) {
                stats.afloat += 1;
            } else if is_sunk(place.bits) {
                stats.sunk += 1;
            } else {
                let species = &scene.species[leaf_species(place.bits) as usize % scene.species.len()];
                let size_m = f64::from(species.size_m * size_ratio(schedule.size));
                let wet = f64::from(species.areal_density_kg_m2) * (1.0 + f64::from(litter.moisture));
                stats.lying += 1;
                stats.mass_kg += wet * size_m * size_m * std::f64::consts::FRAC_PI_4;
            }
        }
        Some(stats)
    }
}
