// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a species.

use bytemuck::must_cast_mut;

use super::wind::deviation_m_s;
use crate::arith::rng::seed_words;
use crate::blocks::{ConesBlock, ResponseBlock, SpeciesBlock};
use crate::convert::{single, word};
use crate::device::leaf::own::WHOLE_STEP;
use crate::device::leaf::record::{AERODYNAMIC, CONE_SPIRAL, SIZE_ONE};
use crate::motion::{ConeSpiral, MotionConstants, MotionTables, Primitive};
use crate::scene::{ConeShape, FlightModel, MAX_SPECIES, Scene, Species};

const _: () = assert!(Primitive::ConeSpiral as u32 == CONE_SPIRAL, "records and scenes have one number");

/// Cells of the turbulence box that an eddy of typical size spans.
const EDDY_CELLS: f32 = 8.0;

pub(super) fn species_block(scene: &Scene, species: &Species, tables: &MotionTables) -> SpeciesBlock {
    let constants = MotionConstants::of(species, scene.gravity_m_s2);
    let dt = f64::from(scene.dt_s);
    let mut rates = [0; 8];
    for (rate, table) in rates.iter_mut().zip(&tables.0) {
        *rate = word(4_294_967_296.0 * dt / table.period_s);
    }
    // The phase of a cone spiral is its age in 2^-16 steps.
    rates[CONE_SPIRAL as usize] = WHOLE_STEP;
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

/// Cone spiral of a species whose leaves fall that way.
pub(super) fn cone_spiral(scene: &Scene, species: &Species) -> Option<ConeSpiral> {
    let is_one = species.flight == FlightModel::Synthesis && species.start == Primitive::ConeSpiral;
    let constants = MotionConstants::of(species, scene.gravity_m_s2);
    is_one.then(|| ConeSpiral::new(&constants, seed_words(scene.seed)))
}

/// Cone spirals of all species.
pub(super) fn cones_block(scene: &Scene) -> ConesBlock {
    let mut block: ConesBlock = bytemuck::Zeroable::zeroed();
    let radii_m: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.radius_m);
    let shares_per_age: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.share_per_age);
    let are_bowls: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.is_bowl);
    let banks_per_m: &mut [f32; MAX_SPECIES] = must_cast_mut(&mut block.bank_per_m);
    let orbit_rates: &mut [u32; MAX_SPECIES] = must_cast_mut(&mut block.orbit_rate);
    let table_rates: &mut [u32; MAX_SPECIES] = must_cast_mut(&mut block.table_rate);
    let start_ages: &mut [u32; MAX_SPECIES] = must_cast_mut(&mut block.start_age);
    let dt = f64::from(scene.dt_s);
    let periods = |per_s: f64| word(4_294_967_296.0 * dt * per_s);
    for (index, species) in scene.species.iter().enumerate() {
        let Some(spiral) = cone_spiral(scene, species) else { continue };
        let constants = MotionConstants::of(species, scene.gravity_m_s2);
        block.count += 1;
        radii_m[index] = single(constants.cone_radius_m);
        shares_per_age[index] = single(constants.descent_m_s * dt / (65536.0 * constants.cone_depth_m));
        are_bowls[index] = f32::from(u8::from(constants.cone_shape == ConeShape::Bowl));
        banks_per_m[index] = single(constants.cone_rad_s * constants.cone_rad_s / constants.gravity_m_s2);
        orbit_rates[index] = periods(constants.cone_rad_s / std::f64::consts::TAU);
        table_rates[index] = periods(1.0 / spiral.period_s());
        start_ages[index] = word(65536.0 * spiral.start_s() / dt);
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
