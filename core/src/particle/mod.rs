// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: their columns, population after population, and what has happened to them.

mod store;

pub use crate::device::particle::record::{ParticleMotion, ParticlePlace, ParticleTraits};
pub use store::{ParticleMut, ParticleStore, ParticlesMut, TalliesMut, TallyMut, TallyStore};
