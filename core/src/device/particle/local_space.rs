// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/local_space.wgsl
//!
//! Motion of particles in the frame of their parent. Columns hold places and velocities in the world: a step takes off the parent's motion,
//! moves the particle, and carries it along with what the parent has moved and turned meanwhile. So all that reads the columns needs to
//! know nothing of it, and when a parent dies its children go on as they are.

use super::fly::ParticleFlight;
use super::record::{PARTICLE_ALIVE, PARTICLE_RESTING, ParticleStart, particle_state};
use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{Vec3, vec3_cross, vec3_dot};
use crate::particle::{ParticleMotion, ParticlePlace};

crate::shared_constants! {
    /// Squared speed in m²/s² below which a frame does not turn.
    pub const FRAME_STILL_SQUARED: f32 = 1e-12;
    /// One more than the cosine of the turn of a step, below which a frame that turns back does not turn at all.
    pub const FRAME_BACK: f32 = 1e-3;
}

/// Motion of a frame over a step.
#[derive(Clone, Copy, Debug)]
pub struct ParticleFrame<R: Real = f32> {
    /// Origin and its velocity at the start.
    pub start: ParticleFlight<R>,
    /// The same at the end.
    pub end: ParticleFlight<R>,
}

impl ParticleFrame {
    /// The frame of the world.
    pub const WORLD: Self = {
        let still = ParticleFlight { position: Vec3::ZERO, velocity: Vec3::ZERO };
        Self { start: still, end: still }
    };
}

/// Frame of the parent of a particle that was born in the step `birth`; the world's if that parent is dead, or another one in its slot.
#[inline(always)]
pub fn parent_frame(
    place: &ParticlePlace,
    motion: &ParticleMotion,
    start: &ParticleStart,
    birth: u32,
) -> ParticleFrame {
    let state = particle_state(place.bits);
    let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
    let is_own = birth.wrapping_sub(motion.birth).cast_signed() >= 0;
    if !is_alive || !is_own {
        return ParticleFrame::WORLD;
    }
    ParticleFrame {
        start: ParticleFlight { position: start.position.into(), velocity: start.velocity.into() },
        end: ParticleFlight { position: place.position.into(), velocity: motion.velocity.into() },
    }
}

/// Frame of a parent while `rest` of a step was left, in which it moved straight on.
#[inline(always)]
pub fn rest_frame(frame: ParticleFrame, way_s: f32) -> ParticleFrame {
    let ParticleFlight { position, velocity } = frame.end;
    ParticleFrame {
        start: ParticleFlight { position: position - velocity * way_s, velocity },
        end: frame.end,
    }
}

/// A vector that the frame turns along with: by the shortest turn from its direction at the start to that at the end.
#[inline(always)]
pub fn frame_turn<R: Real>(frame: ParticleFrame<R>, turned: Vec3<R>) -> Vec3<R> {
    let (before, after) = (frame.start.velocity, frame.end.velocity);
    let squared_before = vec3_dot(before, before);
    let squared_after = vec3_dot(after, after);
    let least = turned.x.all(FRAME_STILL_SQUARED);
    let inverse = inverse_sqrt(squared_before.max(least)) * inverse_sqrt(squared_after.max(least));
    let cross = vec3_cross(before, after) * inverse;
    let near = vec3_dot(before, after) * inverse + 1.0;
    let back = turned.x.all(FRAME_BACK);
    let is_steady = squared_before.less_than(least) | squared_after.less_than(least) | near.less_than(back);
    let across = vec3_cross(cross, turned);
    let change = across + vec3_cross(cross, across) * reciprocal(near.max(back));
    let none = turned.x.all(0.0);
    turned
        + Vec3::new(
            is_steady.select_real(none, change.x),
            is_steady.select_real(none, change.y),
            is_steady.select_real(none, change.z),
        )
}

/// Flight that has the velocity of a particle in its frame.
#[inline(always)]
pub fn in_frame<R: Real>(frame: ParticleFrame<R>, flight: ParticleFlight<R>) -> ParticleFlight<R> {
    ParticleFlight { position: flight.position, velocity: flight.velocity - frame.start.velocity }
}

/// Flight in the world at the end of a step, of which `flight` is the end in the frame as it was at the start.
#[inline(always)]
pub fn carried_flight<R: Real>(frame: ParticleFrame<R>, flight: ParticleFlight<R>) -> ParticleFlight<R> {
    ParticleFlight {
        position: frame.end.position + frame_turn(frame, flight.position - frame.start.position),
        velocity: frame.end.velocity + frame_turn(frame, flight.velocity),
    }
}
