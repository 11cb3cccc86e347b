// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the particles that carry forces.

use crate::convert::{len32, single};
use crate::device::particle::force_carrier::{CARRIER_ROWS, CarrierRun};
use crate::layout::Uint4;
use crate::scene::{ForceCarriers, Scene};

/// Carriers of each force of a scene, a run without any of one that stays where it is, and the points of their curves as rows of the
/// tables from `first_row` on.
pub(super) fn force_carriers(scene: &Scene, first_row: u32) -> (Vec<CarrierRun>, Vec<Uint4>) {
    let mut points = Vec::new();
    let mut next_row = 0;
    let mut runs = Vec::with_capacity(scene.forces.len());
    for force in &scene.forces {
        let mut run: CarrierRun = bytemuck::Zeroable::zeroed();
        let carried_by = force.carried_by.as_ref();
        let population = |by: &ForceCarriers| scene.particles.iter().position(|one| one.name == by.of);
        if let Some((carriers, number)) = carried_by.and_then(|by| Some((by, population(by)?))) {
            run.first = scene.particles[..number].iter().map(|one| one.count).sum();
            run.count = scene.particles[number].count;
            run.first_row = next_row;
            run.first_point_row = first_row + len32(points.len());
            run.point_count = len32(carriers.strength.len());
            next_row += run.count * CARRIER_ROWS;
            points.extend(point_rows(&carriers.strength));
        }
        runs.push(run);
    }
    (runs, points)
}

/// Rows of the points of a curve: age, value and its rise to the next point over the age between them.
fn point_rows(points: &[(f32, f32)]) -> impl Iterator<Item = Uint4> {
    points.iter().enumerate().map(|(number, (age, value))| {
        let rise = points.get(number + 1).map_or(0.0, |(next_age, next)| {
            single((f64::from(*next) - f64::from(*value)) / (f64::from(*next_age) - f64::from(*age)))
        });
        Uint4([*age, *value, rise, 0.0].map(f32::to_bits))
    })
}
