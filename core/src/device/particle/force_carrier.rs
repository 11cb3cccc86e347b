// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/force_carrier.wgsl
//!
//! Forces that particles carry along. Where each carrier is in a step, and how strong its force is, is worked out before any particle moves,
//! so that carriers may act on one another.

use super::record::{PARTICLE_ALIVE, PARTICLE_RESTING, particle_life, particle_state};
use crate::arith::math::reciprocal;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::layout::Uint4;
use crate::particle::{ParticleMotion, ParticlePlace, ParticleTraits};

crate::shared_constants! {
    /// Rows of a carrier: its place halfway through the step in m and a multiplier of the force, 0 unless it is alive; its place at the end.
    pub const CARRIER_ROWS: u32 = 2;
}

crate::shared_struct! {
    /// A force that the particles of a population carry.
    pub struct CarrierRun {
        /// First of them: its slot, or its place in a window of a device.
        pub first: u32,
        /// Number of them.
        pub count: u32,
        /// First row of their places.
        pub first_row: u32,
        /// First row of the points of the curve over their age: age, multiplier and its rise to the next point.
        pub first_point_row: u32,
        /// Number of these points; without any the multiplier is one.
        pub point_count: u32,
        /// Zero.
        pub unused: u32,
        /// Zeros.
        pub unused_pair: [u32; 2],
    }
}

/// Multiplier of a carried force at an age as a share of the carrier's life.
#[inline(always)]
pub fn carried_share(cx: &Context<'_>, run: &CarrierRun, age_share: f32) -> f32 {
    let mut share = 1.0;
    for point in 0..run.point_count {
        let Uint4(words) = cx.tables[(run.first_point_row + point) as usize];
        let [age, value, rise, _] = words.map(f32::from_bits);
        if point == 0 || age <= age_share {
            share = value + rise * (age_share - age).max(0.0);
        }
    }
    share
}

/// Rows of a carrier.
#[inline(always)]
pub fn carrier_rows(
    cx: &Context<'_>,
    run: &CarrierRun,
    place: &ParticlePlace,
    motion: &ParticleMotion,
    traits: &ParticleTraits,
) -> [[f32; 4]; CARRIER_ROWS as usize] {
    let state = particle_state(place.bits);
    let mut share = 0.0;
    if state == PARTICLE_ALIVE || state == PARTICLE_RESTING {
        let life = particle_life(traits.life_size);
        let mut age_share = 0.0;
        if life != 0 {
            age_share = cx.step.index.wrapping_sub(motion.birth) as f32 * reciprocal(life as f32);
        }
        share = carried_share(cx, run, age_share);
    }
    let start = Vec3::from(place.position);
    let velocity = Vec3::from(motion.velocity);
    let middle = start + velocity * (0.5 * cx.scene.dt_s);
    let end = start + velocity * cx.scene.dt_s;
    [[middle.x, middle.y, middle.z, share], [end.x, end.y, end.z, 0.0]]
}
