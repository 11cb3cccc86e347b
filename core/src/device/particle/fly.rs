// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/fly.wgsl
//!
//! Flight of a particle through a step, with nothing in its way.

use super::air::{AIR_LINEAR, AIR_MASSLESS, AIR_STOKES, AIR_VACUUM, air_drag};
use super::force::{force_pull, force_swirl, force_turn};
use super::record::{
    POPULATION_COASTS, POPULATION_MUTUAL, POPULATION_PULLED, POPULATION_SWIRLED, POPULATION_TURNED,
};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::vector::{Vec3, vec3_select};
use crate::blocks::{MOMENT_MIDDLE, MOMENT_NOW, NEVER, PopulationBlock};
use crate::context::Context;
use crate::device::wind::sample::wind_at_moment;

crate::shared_constants! {
    /// Binary logarithm of the slots that sample the air in the same step. Only then is a particle's drag read: long runs of it are read as fast
    /// as memory gives them.
    pub const PARTICLE_UNIT_SHIFT: u32 = 10;
}

/// Speed along an axis in m/s below which there is none: decaying ones would become subnormal, on which processors are slow.
const LEAST_M_S: f32 = 1e-20;

/// A particle on its way.
#[derive(Clone, Copy, Debug)]
pub struct ParticleFlight<R: Real = f32> {
    /// Position in m.
    pub position: Vec3<R>,
    /// Velocity in m/s.
    pub velocity: Vec3<R>,
}

/// A component of a velocity, or nothing if it is tiny.
#[inline(always)]
fn whole_speed<R: Real>(speed: R) -> R {
    speed.max(-speed).less_than(speed.all(LEAST_M_S)).select_real(speed.all(0.0), speed)
}

/// A velocity without components that are tiny.
#[inline(always)]
pub fn whole_velocity<R: Real>(velocity: Vec3<R>) -> Vec3<R> {
    Vec3::new(whole_speed(velocity.x), whole_speed(velocity.y), whole_speed(velocity.z))
}

/// Change of velocity over an interval of steps in the same air, over that in a step in which the share `lost` of the speed is lost.
#[inline(always)]
pub fn interval_share<R: Real>(cx: &Context<'_>, lost: R) -> R {
    let mut share = lost.all(1.0);
    let mut kept = share - lost;
    let mut steps = cx.scene.wind.interval_steps;
    while steps > 1 {
        share = share + share * kept;
        kept = kept * kept;
        steps /= 2;
    }
    share
}

/// A particle after a free step. Linear drag is exact; other places follow from the mean of both velocities. Forces act where half a
/// step takes the particle: with that mean a step is the leapfrog's, which keeps orbits. `mutual` is the acceleration by others of the population.
/// Those that go straight on afterwards sample the air of the middle of an interval of steps, as leaves do, and take the velocity at its end.
#[inline(always)]
pub fn particle_fly<R: Real>(
    cx: &Context<'_>,
    population: &PopulationBlock,
    start: ParticleFlight<R>,
    air: [R; 2],
    mutual: Vec3<R>,
) -> ParticleFlight<R> {
    let ParticleFlight { position, velocity } = start;
    let dt = position.x.all(cx.scene.dt_s);
    let half = position.x.all(0.5 * cx.scene.dt_s);
    let none = position.x.all(0.0);
    let is_massless = population.air == AIR_MASSLESS;
    let mut end = start;
    let (mut moment, mut meeting) = (MOMENT_NOW, position);
    if !is_massless && (population.flags & POPULATION_COASTS) != 0 {
        moment = MOMENT_MIDDLE;
        meeting = position + velocity * position.x.all(cx.scene.wind.half_interval_s);
    }
    // What has no mass goes with the wind that it meets halfway. A loop, so that there is one copy of the long code of the wind.
    let samples = if is_massless { 2 } else { u32::from(population.air != AIR_VACUUM) };
    let mut wind = Vec3::<f32>::ZERO.spread(none);
    for _ in 0..samples {
        wind = wind_at_moment(cx, moment, meeting);
        meeting = position + wind * half;
    }
    if is_massless {
        end.velocity = wind;
        end.position = position + wind * dt;
    } else {
        let mut pull = Vec3::new(none, position.x.all(-population.gravity_m_s2), none);
        if (population.flags & POPULATION_PULLED) != 0 {
            pull = pull + force_pull(cx, population, position + velocity * half);
        }
        if (population.flags & POPULATION_MUTUAL) != 0 {
            pull = pull + mutual;
        }
        let is_linear = population.air == AIR_LINEAR || population.air == AIR_STOKES;
        if is_linear && (population.flags & POPULATION_TURNED) == 0 {
            let slip = wind - velocity;
            let way = air[0] * air[1];
            let lag = dt - way;
            end.position = position + (velocity * dt + (slip * lag + pull * (air[1] * lag)));
            let mut change = slip * air[0] + pull * way;
            if (population.flags & POPULATION_COASTS) != 0 {
                change = change * interval_share(cx, air[0]);
            }
            end.velocity = velocity + change;
        } else {
            let kick = pull * half;
            let mut turned = air_drag(population, wind, velocity + kick, air);
            if (population.flags & POPULATION_TURNED) != 0 {
                turned = force_turn(cx, population, turned);
            }
            end.velocity = turned + kick;
            end.position = position + (velocity + end.velocity) * half;
        }
    }
    end.velocity = whole_velocity(end.velocity);
    if (population.flags & POPULATION_SWIRLED) != 0 {
        end.position = force_swirl(cx, population, end.position);
    }
    end
}

/// Returns true for particles that go straight on in a step: those of some populations sample the air in one step of an interval, units of
/// slots in turns.
#[inline(always)]
pub fn particle_coasts<W: Word>(cx: &Context<'_>, population: &PopulationBlock, slot: W) -> W::Mask {
    if (population.flags & POPULATION_COASTS) == 0 {
        return slot.equals(NEVER);
    }
    let turn = (slot >> PARTICLE_UNIT_SHIFT).plus(slot.all(cx.step.index));
    !(turn & (cx.scene.wind.interval_steps - 1)).equals(0)
}

/// A particle after a free step, straight on if it coasts.
#[inline(always)]
pub fn particle_free_step<R: Real>(
    cx: &Context<'_>,
    population: &PopulationBlock,
    coasts: R::Mask,
    start: ParticleFlight<R>,
    air: [R; 2],
    mutual: Vec3<R>,
) -> ParticleFlight<R> {
    let any_coasts = coasts.any();
    let ahead = start.position + start.velocity * start.position.x.all(cx.scene.dt_s);
    if any_coasts && !(!coasts).any() {
        return ParticleFlight { position: ahead, velocity: start.velocity };
    }
    let end = particle_fly(cx, population, start, air, mutual);
    if !any_coasts {
        return end;
    }
    ParticleFlight {
        position: vec3_select(coasts, ahead, end.position),
        velocity: vec3_select(coasts, start.velocity, end.velocity),
    }
}
