// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the burning of species, and the stages that their leaves go through.

use std::f64::consts::PI;

use super::body::body_block;
use crate::blocks::{BurnBlock, SceneBlock};
use crate::convert::single;
use crate::device::leaf::burn::{BOILING_RISE_K, BURN_INTERVAL, BURN_STAGES, burnt_share};
use crate::litter::Bed;
use crate::scene::{Burning, Scene, Species};

/// Coefficient of heat transfer in W/(m² K) between a leaf and a flame: laminar flow at 3 m/s along 5 cm (Nusselt number 0.664 Re^(1/2)
/// Pr^(1/3)).
const TRANSFER_W_M2_K: f64 = 30.0;
/// Specific heat of dry leaves in J/(kg K).
const LEAF_J_KG_K: f64 = 1_500.0;
/// Specific heat of water in J/(kg K).
const WATER_J_KG_K: f64 = 4_186.0;
/// Heat in J/kg that boils water away.
const EVAPORATION_J_KG: f64 = 2.257e6;
/// Temperature in °C of the air and of leaves in it.
const AMBIENT_C: f64 = 20.0;
/// Water in kg per kg of dry leaf with which no fire spreads: 0.25 to 0.3 of hardwood litter (Albini 1976, USDA General Technical Report INT-30).
const EXTINCTION: f64 = 0.3;
/// Least speed of burning over that of dry leaves.
const LEAST_DAMPING: f64 = 0.1;
/// Intervals within a stage over which its mean mass is taken.
const STAGE_PARTS: u32 = 64;

/// Sets the burning of the species of a scene, and the stages of their leaves behind them.
pub(super) fn set_burning(scene: &Scene, block: &mut SceneBlock) {
    if !scene.leaves_burn() {
        return;
    }
    block.burn_steps = BURN_INTERVAL;
    if scene.wind.plumes.iter().any(|plume| plume.fed_within_m.is_some()) {
        block.first_fire = Bed::first_fire(&block.litter);
    }
    let count = scene.species.len();
    for (index, species) in scene.species.iter().enumerate() {
        let Some(burning) = &species.burns else { continue };
        block.burns[index] = burn_block(scene, species, burning);
        for stage in 1..=BURN_STAGES {
            let number = index + stage as usize * count;
            block.species[number] = block.species[index];
            block.bodies[number] = body_block(&in_stage(scene, species, burning, stage), scene);
            // It still fills the room of a whole leaf.
            let whole = block.bodies[index];
            (block.bodies[number].layer_m, block.bodies[number].litter_units) =
                (whole.layer_m, whole.litter_units);
        }
    }
}

/// A species with the mass that its leaves have on average in a stage, without their water.
fn in_stage(scene: &Scene, species: &Species, burning: &Burning, stage: u32) -> Species {
    let parts = (0..STAGE_PARTS).map(|part| {
        let within = (f64::from(part) + 0.5) / f64::from(STAGE_PARTS);
        let way = (f64::from(stage - 1) + within) / f64::from(BURN_STAGES);
        1.0 - f64::from(burnt_share(single(way))) * (1.0 - f64::from(burning.ash))
    });
    let left = parts.sum::<f64>() / f64::from(STAGE_PARTS);
    let wet = 1.0 + species.moisture(scene.ground.litter.as_ref());
    let areal_density_kg_m2 = single(f64::from(species.areal_density_kg_m2) * left / wet);
    Species { areal_density_kg_m2, ..species.clone() }
}

/// Speed of burning of leaves with water in kg per kg over that of dry ones.
///
/// # Source
/// Rothermel 1972 (USDA Research Paper INT-115), equation 29: it falls to nothing at the moisture of extinction. Wetter leaves, which only a flame
/// dries, smoulder on at [`LEAST_DAMPING`].
fn damping(moisture: f64) -> f64 {
    let ratio = (moisture / EXTINCTION).min(1.0);
    (1.0 + ratio * (-2.59 + ratio * (5.11 - ratio * 3.52))).max(LEAST_DAMPING)
}

/// Burning of a species.
fn burn_block(scene: &Scene, species: &Species, burning: &Burning) -> BurnBlock {
    let (dt, size_m) = (f64::from(scene.dt_s), f64::from(species.size_m));
    let areal = f64::from(species.areal_density_kg_m2);
    let water = areal * species.moisture(scene.ground.litter.as_ref());
    // The front runs over the leaf along its midrib.
    let planform = species.shape.planform();
    let length_m = size_m
        * f64::from(planform.extent)
        * libm::sqrt(f64::from(planform.aspect.max(1.0 / planform.aspect)));
    let moisture = species.moisture(scene.ground.litter.as_ref());
    let seconds = 1000.0 * length_m / (f64::from(burning.front_mm_s) * damping(moisture));
    let burnt_kg = PI / 4.0 * size_m * size_m * areal * (1.0 - f64::from(burning.ash));
    let (dry_j, wet_j) = (areal * LEAF_J_KG_K, areal * LEAF_J_KG_K + water * WATER_J_KG_K);
    let interval_s = f64::from(BURN_INTERVAL) * dt;
    let [least_k, most_k] = [burning.ignition_c.0, burning.ignition_c.1].map(|c| f64::from(c) - AMBIENT_C);
    BurnBlock {
        steps: single(seconds / dt),
        mean_w: single(burnt_kg * f64::from(burning.heat_mj_kg) * 1e6 / seconds),
        // No leaf becomes hotter than the air within an interval.
        exchange_j_m2_k: single((2.0 * TRANSFER_W_M2_K * interval_s).min(dry_j)),
        wet_m2_k_j: single(1.0 / wet_j),
        dry_j_m2: single(f64::from(BOILING_RISE_K) * wet_j + water * EVAPORATION_J_KG),
        dry_m2_k_j: single(1.0 / dry_j),
        ignition_k: single(least_k),
        ignition_span_k: single(most_k - least_k),
    }
}
