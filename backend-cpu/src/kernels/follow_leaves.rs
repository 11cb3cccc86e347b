// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/follow_leaves.wgsl
//!
//! Lets the particles of burning leaves be where these are at the end of a step.

use windfall_core::Context;
use windfall_core::device::particle::on_leaf::{FollowedLeaf, particle_on_leaf};
use windfall_core::leaf::{Burns, Leaves};
use windfall_core::particle::{ParticleStore, leaf_particles};

use crate::simd::branch_block::word;

/// Lets all of them follow.
pub(crate) fn follow_leaves(cx: &Context<'_>, leaves: &Leaves, burns: &Burns, particles: &mut ParticleStore) {
    let mut particles = particles.as_mut();
    for run in leaf_particles(cx.scene, word(leaves.len())) {
        for (slot, burn) in (0..).zip(&burns.burn) {
            let (place, drift) = (&leaves.place[slot as usize], &leaves.drift[slot as usize]);
            let mut particle = particles.row_mut((run.first + slot) as usize);
            let (at, velocity) = (place.position.into(), drift.velocity.into());
            let leaf = FollowedLeaf { slot, bits: place.bits, place: at, velocity };
            particle_on_leaf(cx, &mut particle, run.population, &leaf, burn);
        }
    }
}
