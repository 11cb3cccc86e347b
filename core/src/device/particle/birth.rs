// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/birth.wgsl
//!
//! Birth of a particle: a slot asks if one of the numbers that are born in a step falls on it. So there is no list of free slots, and
//! no order of threads matters.

use super::air::air_numbers;
use super::draw::{particle_words, spread_draw};
use super::record::{
    DIRECTION_AROUND, DIRECTION_CAP, PARTICLE_ALIVE, PARTICLE_BORN, ParticleMotion, ParticlePlace,
    ParticleTraits, life_size_word, particle_bits,
};
use crate::arith::lane::{Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal, sin_cos_turns};
use crate::arith::rng::unit_float;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::blocks::{BirthBlock, NEVER, PopulationBlock};
use crate::context::Context;
use crate::particle::ParticleMut;

crate::shared_constants! {
    /// Kind of a box.
    pub const PARTICLE_BOX: u32 = 0;
    /// Kind of a disc.
    pub const PARTICLE_DISC: u32 = 1;
    /// Kind of a ring.
    pub const PARTICLE_RING: u32 = 2;
    /// Kind of a ball.
    pub const PARTICLE_BALL: u32 = 3;
    /// Kind of a ball's surface.
    pub const PARTICLE_SHELL: u32 = 4;
    /// Kind of a cone.
    pub const PARTICLE_CONE: u32 = 5;
    /// Kind of a line.
    pub const PARTICLE_LINE: u32 = 6;
    /// Kind of points that take turns.
    pub const PARTICLE_FEET: u32 = 7;
    /// Turn from one of these points to the next in 2^-32 turns: the golden angle.
    pub const FOOT_TURN: u32 = 0x61c8_8647;
    /// Random words of the place.
    pub const DRAW_PLACE: u32 = 0;
    /// More of them.
    pub const DRAW_DEPTH: u32 = 1;
    /// Random words of direction and speed.
    pub const DRAW_MOTION: u32 = 2;
    /// Random words of life and size.
    pub const DRAW_LIFE: u32 = 3;
    /// Random words of drag and of the moment within the step.
    pub const DRAW_AIR: u32 = 4;
    /// Longest life in steps, and largest size in 2^-14 of the mean.
    pub const MOST_TRAIT: f32 = 65535.0;
}

/// Number among the births of a step of the one that falls on a place among the slots of a population: [`NEVER`] if none does.
#[inline(always)]
pub fn birth_number(birth: &BirthBlock, count: u32, place: u32) -> u32 {
    let wrapped = if place < birth.first_place { place + count } else { place };
    let number = wrapped - birth.first_place;
    if number < birth.count { number } else { NEVER }
}

/// Root of a number that is not negative.
#[inline(always)]
fn root(x: f32) -> f32 {
    x * inverse_sqrt(x.max(TINY_SQUARED))
}

/// Random point of a shape, uniform by its measure, as three coordinates from -1 to 1. A number of which the square or the cube is
/// uniform is the larger of two uniform ones, or the largest of three.
#[inline(always)]
pub fn shape_point(shape: u32, near: [u32; 4], far: [u32; 4]) -> Vec3 {
    let [a, b, c, d] = near.map(unit_float);
    let e = unit_float(far[0]);
    if shape == PARTICLE_BOX {
        return Vec3::new(a * 2.0 - 1.0, b * 2.0 - 1.0, c * 2.0 - 1.0);
    }
    if shape == PARTICLE_LINE {
        return Vec3::new(0.0, a * 2.0 - 1.0, 0.0);
    }
    let (sine, cosine) = sin_cos_turns(far[1]);
    if shape == PARTICLE_BALL || shape == PARTICLE_SHELL {
        let up = a * 2.0 - 1.0;
        let across = root((1.0 - up * up).max(0.0));
        let radius = if shape == PARTICLE_BALL { b.max(c).max(d) } else { 1.0 };
        return Vec3::new((across * cosine) * radius, up * radius, (across * sine) * radius);
    }
    let along = if shape == PARTICLE_CONE { a.max(b).max(c) } else { 0.0 };
    let mut radius = d.max(e);
    if shape == PARTICLE_RING {
        radius = 1.0;
    }
    if shape == PARTICLE_CONE {
        radius *= along;
    }
    Vec3::new(radius * cosine, along, radius * sine)
}

/// Point of a shape whose points take turns, for the birth of a number: on a disc, each with as much of its area, as coordinates from
/// -1 to 1.
#[inline(always)]
pub fn foot_point(feet: u32, id: u32) -> Vec3 {
    let foot = id % feet;
    let radius = root((foot.to_real() + 0.5) * reciprocal(feet.to_real()));
    let (sine, cosine) = sin_cos_turns(foot.times(FOOT_TURN));
    Vec3::new(radius * cosine, 0.0, radius * sine)
}

/// Random direction on a cap about the axis of a population.
#[inline(always)]
pub fn cap_direction(population: &PopulationBlock, a: u32, b: u32) -> Vec3 {
    let drop = population.cap * unit_float(a);
    let across = root((drop * (2.0 - drop)).max(0.0));
    let (sine, cosine) = sin_cos_turns(b);
    let sideward =
        Vec3::from(population.side) * (across * cosine) + Vec3::from(population.front) * (across * sine);
    Vec3::from(population.axis) * (1.0 - drop) + sideward
}

/// Whole positive number that fits 16 bits.
#[expect(clippy::manual_clamp, reason = "written as in WGSL")]
#[inline(always)]
pub fn trait_word(number: f32) -> u32 {
    (number + 0.5).floor().max(1.0).min(MOST_TRAIT).to_whole()
}

/// Lets a particle be born, number `id` of its population, and returns the part of the step that is left to it.
#[inline(always)]
pub fn particle_birth(cx: &Context<'_>, particle: &mut ParticleMut<'_>, number: u32, id: u32) -> f32 {
    let population = &cx.scene.populations[number as usize];
    let seed = cx.scene.seed;
    let near = particle_words(seed, number, id, DRAW_PLACE);
    let far = particle_words(seed, number, id, DRAW_DEPTH);
    let [turn, tilt, speed_a, speed_b] = particle_words(seed, number, id, DRAW_MOTION);
    let [life_a, life_b, size_a, size_b] = particle_words(seed, number, id, DRAW_LIFE);
    let [air_a, air_b, moment, _] = particle_words(seed, number, id, DRAW_AIR);
    let mut point = shape_point(population.shape, near, far);
    if population.shape == PARTICLE_FEET {
        point = foot_point(population.feet, id);
    }
    let spread = Vec3::from(population.span_x_m) * point.x
        + (Vec3::from(population.span_y_m) * point.y + Vec3::from(population.span_z_m) * point.z);
    let mut direction = cap_direction(population, turn, tilt);
    let mut toward = spread;
    if population.direction == DIRECTION_AROUND {
        toward = vec3_cross(Vec3::from(population.axis), spread);
    }
    let squared = vec3_dot(toward, toward);
    if population.direction != DIRECTION_CAP && TINY_SQUARED < squared {
        direction = toward * inverse_sqrt(squared);
    }
    let speed = spread_draw(population.speed_m_s, speed_a, speed_b).max(0.0);
    let mut life = 0;
    if 0.0 < population.life_steps.mean {
        life = trait_word(spread_draw(population.life_steps, life_a, life_b));
    }
    let size = trait_word(spread_draw(population.size, size_a, size_b));
    *particle.place = ParticlePlace {
        position: (Vec3::from(population.center_m) + spread).to_array(),
        bits: particle_bits(PARTICLE_ALIVE, number) | PARTICLE_BORN,
    };
    *particle.motion = ParticleMotion { velocity: (direction * speed).to_array(), birth: cx.step.index };
    *particle.traits = ParticleTraits {
        id,
        life_size: life_size_word(life, size),
        air: air_numbers(cx, population, size, air_a, air_b),
    };
    if cx.step.births[number as usize].is_burst != 0 { 1.0 } else { 1.0 - unit_float(moment) }
}
