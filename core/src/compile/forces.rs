// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles forces on particles into rows of a table.

use glam::DVec3;

use crate::convert::single;
use crate::device::particle::force::{FORCE_ATTRACT, FORCE_NOISE, FORCE_ROWS, FORCE_SWIRL, FORCE_TURN};
use crate::device::particle::force_carrier::CarrierRun;
use crate::device::particle::record::{
    POPULATION_MUTUAL, POPULATION_PULLED, POPULATION_SWIRLED, POPULATION_TURNED,
};
use crate::device::wind::vortex::SWIRL_COMPACT;
use crate::layout::Uint4;
use crate::scene::{Force, ForceKind, Particles, Scene, SwirlProfile};

/// Forces that a population feels, in its order, each with those that carry it: `carriers` has a run for every force of the scene.
pub(super) fn felt<'a>(
    scene: &'a Scene,
    carriers: &'a [CarrierRun],
    particles: &'a Particles,
) -> impl Iterator<Item = (&'a Force, &'a CarrierRun)> {
    let named = move |name: &String| scene.forces.iter().zip(carriers).find(|(force, _)| force.name == *name);
    particles.feels.iter().filter_map(named)
}

/// Flag that a force sets in a population that feels it.
pub(super) fn flag_of(force: &Force) -> u32 {
    match force.of {
        ForceKind::Attract { .. } | ForceKind::Noise { .. } => POPULATION_PULLED,
        ForceKind::Lorentz { .. } => POPULATION_PULLED | POPULATION_TURNED,
        ForceKind::Mutual { .. } => POPULATION_MUTUAL,
        ForceKind::Spiral { .. } => POPULATION_TURNED,
        ForceKind::Swirl { .. } => POPULATION_SWIRLED,
    }
}

/// The rows of a force on a population.
pub(super) fn force_rows(
    scene: &Scene,
    particles: &Particles,
    force: &Force,
    carriers: &CarrierRun,
) -> [Uint4; FORCE_ROWS as usize] {
    let dt = f64::from(scene.dt_s);
    let row = |numbers: [f64; 4]| Uint4(numbers.map(|number| single(number).to_bits()));
    let vector = |of: DVec3| row([of.x, of.y, of.z, 0.0]);
    let kind = |kind: u32, profile: u32| Uint4([kind, profile, carriers.first_row, carriers.count]);
    let turned = |pull: DVec3, half: DVec3| {
        let back = half * (2.0 / (1.0 + half.length_squared()));
        [kind(FORCE_TURN, 0), vector(pull), vector(half), vector(back)]
    };
    match force.of {
        ForceKind::Attract { at_m, gm_m3_s2, softening_m } => {
            let softening = f64::from(softening_m);
            let numbers = row([gm_m3_s2.into(), softening * softening, 0.0, 0.0]);
            [kind(FORCE_ATTRACT, 0), numbers, vector(at_m.as_dvec3()), Uint4::default()]
        }
        ForceKind::Mutual { .. } => [Uint4::default(); FORCE_ROWS as usize],
        ForceKind::Noise { m_s2, cell_m } => {
            let numbers = row([m_s2.into(), 1.0 / f64::from(cell_m), 0.0, 0.0]);
            [kind(FORCE_NOISE, 0), numbers, Uint4::default(), Uint4::default()]
        }
        ForceKind::Lorentz { b_t, e_v_m } => {
            let charge = f64::from(particles.charge_c_kg);
            turned(e_v_m.as_dvec3() * charge, b_t.as_dvec3() * (0.5 * charge * dt))
        }
        ForceKind::Spiral { rad_s, axis } => {
            let half = libm::tan(0.5 * f64::from(rad_s) * dt);
            turned(DVec3::ZERO, axis.as_dvec3().normalize() * -half)
        }
        ForceKind::Swirl { at_m, axis, rate_rad_s, swirl_radius_m, profile } => {
            let (number, d) = match profile {
                SwirlProfile::Power { alpha } => (alpha, 0.0),
                SwirlProfile::Compact { d } => (SWIRL_COMPACT, f64::from(d)),
            };
            let numbers = row([f64::from(rate_rad_s) * dt, 1.0 / f64::from(swirl_radius_m), d, 0.0]);
            let axis = axis.as_dvec3().normalize();
            [kind(FORCE_SWIRL, number), numbers, vector(at_m.as_dvec3()), vector(axis)]
        }
    }
}
