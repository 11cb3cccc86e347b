// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cumulative tables of the primitive motions: what the simulation reads in place of the equations.
//!
//! For every primitive a table holds displacement, orientation and velocity over one period. The state at any phase
//! is one lookup and a step is a difference of two, so a path neither depends on the time step nor drifts.

use super::constants::MotionConstants;
use super::orientation;
use super::path::Path;
use super::primitive::JOINED_COUNT;
use super::rotation_ode;
use super::{
    PeriodicFluttering, PeriodicSpiraling, PeriodicTumbling, SteadyDescent, TransitionalChaotic,
    TransitionalHelical,
};
use crate::scene::{RotationModel, Species};

crate::shared_constants! {
    /// Binary logarithm of the number of table intervals per period.
    pub const TABLE_BITS: u32 = 9;
    /// Rows stored per table: both ends of the period.
    pub const TABLE_ROWS: u32 = 513;
    /// Slots of tables per species: one for each number of a primitive motion, and one more.
    pub const TABLES_PER_SPECIES: u32 = 8;
}

/// Intervals of a table.
pub(crate) const INTERVALS: usize = 1 << TABLE_BITS;

/// One primitive motion over one period, at `TABLE_ROWS` equally spaced times.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimitiveTable {
    /// Length of the period in seconds for a leaf of the species' own size and speed.
    pub period_s: f64,
    /// Displacement since the start of the period in metres; the first row is zero.
    pub displacement_m: Vec<[f32; 3]>,
    /// Orientation as unit quaternions x, y, z, w; the last row is the first as a rotation.
    pub orientation: Vec<[f32; 4]>,
    /// Velocity in metres per period.
    pub velocity_m: Vec<[f32; 3]>,
}

/// The tables of one species, in the order of [`Primitive::JOINED`](super::Primitive::JOINED). That of the cone spiral, of which a table is but a part, is
/// [`ConeSpiral::table`](super::ConeSpiral::table).
#[derive(Clone, Debug, PartialEq)]
pub struct MotionTables(pub [PrimitiveTable; JOINED_COUNT]);

impl MotionTables {
    /// Tables from the equations; `seed` chooses the random parts (wandering, chaotic sequence).
    pub fn generate(species: &Species, seed: [u32; 2], gravity_m_s2: f32) -> Self {
        let constants = MotionConstants::of(species, gravity_m_s2);
        let rotation = species.rotation;
        Self([
            sample(&SteadyDescent::new(&constants, seed), &constants, rotation),
            sample(&PeriodicTumbling::new(&constants), &constants, rotation),
            sample(&TransitionalChaotic::new(&constants, seed), &constants, rotation),
            sample(&PeriodicFluttering::new(&constants), &constants, rotation),
            sample(&TransitionalHelical::new(&constants), &constants, rotation),
            sample(&PeriodicSpiraling::new(&constants), &constants, rotation),
        ])
    }
}

fn sample(path: &impl Path, constants: &MotionConstants, rotation: RotationModel) -> PrimitiveTable {
    let period_s = path.period_s();
    let moments: Vec<_> =
        (0..=INTERVALS).map(|row| path.at(period_s * row as f64 / INTERVALS as f64)).collect();
    let orientation = match rotation {
        RotationModel::SpecificForce => orientation::orientations(path, INTERVALS, constants.gravity_m_s2),
        RotationModel::TanabeKaneko { friction_per_s } => {
            rotation_ode::orientations(path, INTERVALS, constants, f64::from(friction_per_s))
        }
    };
    let start = moments[0].position;
    PrimitiveTable {
        period_s,
        displacement_m: moments.iter().map(|moment| (moment.position - start).as_vec3().to_array()).collect(),
        orientation: orientation.into_iter().map(|pose| pose.as_quat().to_array()).collect(),
        velocity_m: moments.iter().map(|moment| (moment.velocity * period_s).as_vec3().to_array()).collect(),
    }
}
