// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/follow_leaves.wgsl
//!
//! Lets the particles of burning leaves be where these are at the end of a step.

use rayon::join;
use windfall_core::Context;
use windfall_core::device::particle::on_leaf::{FollowedLeaf, LeafParticles, particle_on_leaf};
use windfall_core::leaf::{Burns, Leaves};
use windfall_core::particle::{ParticleStore, ParticlesMut, leaf_particles};

use super::CHUNK;
use crate::simd::branch_block::word;

/// Lets all of them follow.
pub(crate) fn follow_leaves(cx: &Context<'_>, leaves: &Leaves, burns: &Burns, particles: &mut ParticleStore) {
    for run in leaf_particles(cx.scene, word(leaves.len())) {
        let (_, others) = particles.as_mut().split_at(run.first as usize);
        let (own, _) = others.split_at(run.count as usize);
        follow_run(cx, &run, (leaves, burns), own, 0);
    }
}

/// Lets particles from that of the leaf in slot `first` on follow, halving them until a piece is one chunk.
fn follow_run(
    cx: &Context<'_>,
    run: &LeafParticles,
    leaves: (&Leaves, &Burns),
    mut particles: ParticlesMut<'_>,
    first: usize,
) {
    if particles.len() > CHUNK {
        let middle = particles.len() / 2;
        let (front, back) = particles.split_at(middle);
        join(
            || follow_run(cx, run, leaves, front, first),
            || follow_run(cx, run, leaves, back, first + middle),
        );
        return;
    }
    let (leaves, burns) = leaves;
    for (slot, mut particle) in (first..).zip(particles.iter_mut()) {
        let (place, velocity) = (leaves.place[slot], leaves.drift[slot].velocity.into());
        let (bits, place) = (place.bits, place.position.into());
        let leaf = FollowedLeaf { slot: word(slot), bits, place, velocity };
        particle_on_leaf(cx, &mut particle, run.population, &leaf, &burns.burn[slot]);
    }
}
