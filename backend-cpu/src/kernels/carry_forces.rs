// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/carry_forces.wgsl
//!
//! Places the forces that particles carry, before any particle moves. There are few of them, so one thread does.

use windfall_core::Context;
use windfall_core::particle::{CarrierRun, ParticleStore, place_carriers};

/// Fills the rows of all carriers.
pub(crate) fn carry_forces(
    cx: &Context<'_>,
    runs: &[CarrierRun],
    particles: &ParticleStore,
    rows: &mut Vec<[f32; 4]>,
) {
    place_carriers(cx, runs, particles, rows);
}
