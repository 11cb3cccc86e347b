// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: their columns, population after population, what has happened to them, and samples of their ways.

mod history;
mod run;
mod stats;
mod store;

pub use crate::device::particle::force_carrier::CarrierRun;
pub use crate::device::particle::history::{HistoryRun, HistorySample};
pub use crate::device::particle::on_leaf::LeafParticles;
pub use crate::device::particle::record::{
    ParticleMotion, ParticlePlace, ParticleRun, ParticleStart, ParticleTraits,
};
pub(crate) use history::keep_all;
pub use history::{HistoriesMut, HistoryMut, HistoryStore, history_runs, steps_to_sample, way_of};
pub use run::{Generation, add_to_tally, each_generation, leaf_particles, place_carriers};
pub(crate) use run::{follow_leaves, step_all, step_run};
pub use stats::ParticleStats;
pub use store::{
    HOT_BYTES_PER_STEP, ParticleMut, ParticleRows, ParticleStore, ParticlesMut, TalliesMut, TallyMut,
    TallyStore,
};
