// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/air.wgsl
//!
//! Drag of the air on a particle, from the numbers that it is born with. Linear drag over a step is exact: a particle keeps
//! `e^(-dt/tau)` of its speed through the air.

use crate::arith::lane::Real;
use crate::arith::math::{EXP_2, EXP_3, EXP_4, EXP_5, EXP_6, EXP_7, exponential, inverse_sqrt, reciprocal};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::blocks::PopulationBlock;
use crate::context::Context;
use crate::device::particle::draw::spread_draw;

crate::shared_constants! {
    /// No drag.
    pub const AIR_VACUUM: u32 = 0;
    /// Linear drag, whatever the size.
    pub const AIR_LINEAR: u32 = 1;
    /// Linear drag by size.
    pub const AIR_STOKES: u32 = 2;
    /// Quadratic drag by size.
    pub const AIR_QUADRATIC: u32 = 3;
    /// Particles go with the air.
    pub const AIR_MASSLESS: u32 = 4;
    /// Exponent below which the share that is lost is summed by its own series.
    pub const SMALL_EXPONENT: f32 = 0.34;
    /// Size in 2^-14 of the mean as a share.
    pub const PARTICLE_SIZE_UNIT: f32 = 1.0 / 16384.0;
}

/// `1 - e^-x` within 3e-7 relative, for positive x.
#[inline(always)]
pub fn lost_share(x: f32) -> f32 {
    if SMALL_EXPONENT < x {
        return 1.0 - exponential(-x);
    }
    let r = -x;
    let series = EXP_2 + r * (EXP_3 + r * (EXP_4 + r * (EXP_5 + r * (EXP_6 + r * EXP_7))));
    x - (r * r) * series
}

/// The two numbers of its drag that a particle is born with, from its size and two random words.
#[inline(always)]
pub fn air_numbers(cx: &Context<'_>, population: &PopulationBlock, size: u32, a: u32, b: u32) -> [f32; 2] {
    let ratio = size as f32 * PARTICLE_SIZE_UNIT;
    let drag = spread_draw(population.drag, a, b);
    if population.air == AIR_QUADRATIC {
        return [drag * reciprocal(ratio), 0.0];
    }
    if population.air != AIR_LINEAR && population.air != AIR_STOKES {
        return [0.0, 0.0];
    }
    let time_s = if population.air == AIR_STOKES { drag * (ratio * ratio) } else { drag };
    [lost_share(cx.scene.dt_s * reciprocal(time_s)), time_s]
}

/// Velocity after a step of drag alone.
#[inline(always)]
pub fn air_drag<R: Real>(
    population: &PopulationBlock,
    wind: Vec3<R>,
    velocity: Vec3<R>,
    air: [R; 2],
) -> Vec3<R> {
    if population.air == AIR_VACUUM {
        return velocity;
    }
    let through = velocity - wind;
    if population.air == AIR_QUADRATIC {
        let squared = vec3_dot(through, through);
        let speed = squared * inverse_sqrt(squared.max(squared.all(TINY_SQUARED)));
        return wind + through * reciprocal(air[0] * speed + 1.0);
    }
    velocity - through * air[0]
}
