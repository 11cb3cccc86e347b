// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a species.

use bytemuck::must_cast_mut;

use super::wind::deviation_m_s;
use crate::blocks::{ResponseBlock, SpeciesBlock};
use crate::convert::{single, word};
use crate::device::leaf::record::{AERODYNAMIC, SIZE_ONE};
use crate::motion::{MotionConstants, MotionTables};
use crate::scene::{FlightModel, MAX_SPECIES, Scene, Species};

/// Cells of the turbulence box that an eddy of typical size spans.
const EDDY_CELLS: f32 = 8.0;

pub(super) fn species_block(scene: &Scene, species: &Species, tables: &MotionTables) -> SpeciesBlock {
    let constants = MotionConstants::of(species, scene.gravity_m_s2);
    let dt = f64::from(scene.dt_s);
    let mut rates = [0; 8];
    for (rate, table) in rates.iter_mut().zip(&tables.0) {
        *rate = word(4_294_967_296.0 * dt / table.period_s);
    }
    let mut transitions = [0; 36];
    for (count, entry) in transitions.iter_mut().zip(species.transitions.0.iter().flatten()) {
        *count = *entry;
    }
    let first_motion = match species.flight {
        FlightModel::Synthesis => species.start as u32,
        FlightModel::Aerodynamic(_) => AERODYNAMIC,
    };
    SpeciesBlock {
        fall_steps_q16_per_m: word(65536.0 / (constants.descent_m_s * dt)),
        size_spread_q14: spread(species.size_variation),
        speed_spread_q14: spread(species.speed_variation),
        first_motion,
        rates: bytemuck::cast(rates),
        transitions: bytemuck::cast(transitions),
    }
}

/// Responses of all species.
pub(super) fn response_block(scene: &Scene) -> ResponseBlock {
    let mut block: ResponseBlock = bytemuck::Zeroable::zeroed();
    let drifts_kept: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.drift_kept);
    let fastest_spins: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.fastest_spin);
    let time_constants_s: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.time_constant_s);
    let inv_time_constants: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.inv_time_constant);
    for (index, species) in scene.species.iter().enumerate() {
        let tau = MotionConstants::of(species, scene.gravity_m_s2).response_s();
        drifts_kept[index] = single(libm::exp(-f64::from(scene.dt_s) / tau));
        fastest_spins[index] = fastest_spin(scene, species);
        time_constants_s[index] = single(tau);
        inv_time_constants[index] = single(1.0 / tau);
    }
    block
}

/// Fastest spin per step in 2^-18 turns, a whole number. Wind makes leaves spin faster by what they lag behind its turbulence, in
/// units of their own descent: an average over the scene, so that the angle stays an integer everywhere.
fn fastest_spin(scene: &Scene, species: &Species) -> f32 {
    let constants = MotionConstants::of(species, scene.gravity_m_s2);
    let mean = scene.wind.speed.metres_per_second();
    let deviation = f64::from(deviation_m_s(&scene.wind));
    let eddy_s = f64::from(EDDY_CELLS * scene.wind.turbulence.cell_m) / mean.max(0.1);
    let tau = constants.response_s();
    let lag = deviation * libm::sqrt(tau / (tau + eddy_s));
    let per_step = f64::from(species.spin_rad_s) * f64::from(scene.dt_s) * f64::from(scene.rotation_speed)
        / std::f64::consts::TAU;
    single(libm::floor((per_step * (1.0 + lag / constants.descent_m_s) * 262_144.0).min(65535.0)))
}

fn spread(variation: f32) -> u32 {
    word(f64::from(variation) * f64::from(SIZE_ONE))
}
