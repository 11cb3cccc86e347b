// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/mutual.wgsl
//!
//! Attraction of the particles of a population by one another: a direct sum in the order of their slots, so that every backend adds the
//! same numbers in the same order.

use super::record::{PARTICLE_ALIVE, PARTICLE_RESTING, particle_state};
use crate::arith::lane::Real;
use crate::arith::math::inverse_sqrt;
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::PopulationBlock;
use crate::context::Context;
use crate::particle::{ParticleMotion, ParticlePlace};

/// A particle as others feel it: where half a step takes it, and its product GM in m³/s², nothing unless it is alive.
#[inline(always)]
pub fn mutual_source(
    cx: &Context<'_>,
    population: &PopulationBlock,
    place: &ParticlePlace,
    motion: &ParticleMotion,
) -> [f32; 4] {
    let half = 0.5 * cx.scene.dt_s;
    let middle = Vec3::from(place.position) + Vec3::from(motion.velocity) * half;
    let state = particle_state(place.bits);
    let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
    let [x, y, z] = middle.to_array();
    [x, y, z, if is_alive { population.mutual_gm_m3_s2 } else { 0.0 }]
}

/// Acceleration of a particle whose place is `middle`, another one's attraction added. Of itself it feels none.
#[inline(always)]
pub fn mutual_pull<R: Real>(
    population: &PopulationBlock,
    pull: Vec3<R>,
    middle: Vec3<R>,
    source: [f32; 4],
) -> Vec3<R> {
    let [x, y, z, strength] = source;
    let toward = Vec3::new(x, y, z).spread(middle.x) - middle;
    let inverse = inverse_sqrt(vec3_dot(toward, toward) + population.mutual_softening_m2);
    pull + toward * (((inverse * inverse) * inverse) * strength)
}
