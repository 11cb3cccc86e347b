// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/on_leaf.wgsl
//!
//! Particles that are where leaves burn, one for each leaf: born as it catches, dead as it has burnt or water puts it out. So embers, sparks
//! and flames are born of leaves as of any other particles.

use super::birth::{particle_birth, trait_word};
use super::record::{PARTICLE_ALIVE, life_size_word, particle_size, particle_state};
use crate::arith::lane::Word;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::leaf::burn::{Burn, UNLIT, burn_way};
use crate::device::leaf::record::{STATE_DORMANT, flies, leaf_state};
use crate::particle::ParticleMut;

crate::shared_struct! {
    /// Particles of the leaves of a world, or of a window of them.
    pub struct LeafParticles {
        /// First of them: its slot, or its place in a window of a device.
        pub first: u32,
        /// Number of leaves.
        pub count: u32,
        /// Slot of the first leaf.
        pub first_leaf: u32,
        /// Number of the population.
        pub population: u32,
    }
}

/// A leaf that a particle follows.
#[derive(Clone, Copy, Debug)]
pub struct FollowedLeaf {
    /// Its slot.
    pub slot: u32,
    /// Its bits.
    pub bits: u32,
    /// Its place.
    pub place: Vec3,
    /// Its velocity, if it flies.
    pub velocity: Vec3,
}

/// Lets the particle of a leaf be where that is at the end of a step.
#[inline(always)]
pub fn particle_on_leaf(
    cx: &Context<'_>,
    particle: &mut ParticleMut<'_>,
    population: u32,
    leaf: &FollowedLeaf,
    burn: &Burn,
) {
    let time = cx.step.index.wrapping_add(1);
    let is_alive = particle_state(particle.place.bits) == PARTICLE_ALIVE;
    let burns = burn.lit != UNLIT && burn_way(time, burn) < 1.0 && leaf_state(leaf.bits) != STATE_DORMANT;
    if !burns {
        if is_alive {
            let age = time.wrapping_sub(particle.motion.birth);
            particle.traits.life_size =
                life_size_word(trait_word(age.to_real()), particle_size(particle.traits.life_size));
        }
        return;
    }
    if !is_alive {
        particle_birth(cx, particle, population, leaf.slot);
        let age = time.wrapping_sub(burn.lit);
        particle.motion.birth = time;
        particle.traits.life_size =
            life_size_word(trait_word(burn.steps - age.to_real()), particle_size(particle.traits.life_size));
    }
    particle.place.position = leaf.place.to_array();
    particle.motion.velocity = if flies(leaf.bits) { leaf.velocity.to_array() } else { [0.0; 3] };
}
