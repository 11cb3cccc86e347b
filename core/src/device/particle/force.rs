// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/force.wgsl
//!
//! Forces on particles besides weight and drag: rows of a table, those that a population feels one after another.

use crate::arith::lane::Real;
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::blocks::PopulationBlock;
use crate::context::Context;
use crate::device::particle::force_carrier::CARRIER_ROWS;
use crate::device::wind::turbulence::turbulence_in_cells;
use crate::device::wind::vortex::swirl_profile;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Rows of a force: its kind, its profile, the first row of its carriers and their number; four numbers; two vectors.
    pub const FORCE_ROWS: u32 = 4;
    /// Attraction by a point: numbers are strength in m³/s² and squared softening in m²; the first vector is the point, from a carrier on.
    pub const FORCE_ATTRACT: u32 = 0;
    /// Acceleration by a frozen field of noise: numbers are m/s² and cells per m.
    pub const FORCE_NOISE: u32 = 1;
    /// Constant acceleration, the first three numbers, and a turn of the velocity in Cayley's form, both vectors.
    pub const FORCE_TURN: u32 = 2;
    /// Turn of the place about an axis: numbers are the angle of a step, cells of a radius per m, and d of the profile; vectors are
    /// centre, from a carrier on, and axis.
    pub const FORCE_SWIRL: u32 = 3;
    /// Largest angle of a swirl in a step, in radians.
    pub const SWIRL_MOST: f32 = 0.5;
}

/// Kind, profile, first row of the carriers and their number of a force.
#[inline(always)]
fn force_kind(cx: &Context<'_>, first: u32) -> [u32; 4] {
    let Uint4(words) = cx.tables[first as usize];
    words
}

/// Four floats of a row of a force.
#[inline(always)]
fn force_row(cx: &Context<'_>, row: u32) -> [f32; 4] {
    let Uint4(words) = cx.tables[row as usize];
    words.map(f32::from_bits)
}

/// Three floats of a row of a force.
#[inline(always)]
fn force_vector(cx: &Context<'_>, row: u32) -> Vec3 {
    let [x, y, z, _] = force_row(cx, row);
    Vec3::new(x, y, z)
}

/// A place from which a force acts, and a multiplier of the force there.
#[derive(Clone, Copy, Debug)]
pub struct ForceSource {
    /// Place in m.
    pub place: Vec3,
    /// Multiplier, 0 of a carrier that is not alive.
    pub share: f32,
}

/// Place from which a force acts that has `carriers` of them from a row on: one of these with `at` added, `CARRIER_ROWS` rows each, or
/// `at` itself.
#[inline(always)]
pub fn force_source(cx: &Context<'_>, carriers: u32, row: u32, at: Vec3) -> ForceSource {
    if carriers == 0 {
        return ForceSource { place: at, share: 1.0 };
    }
    let [x, y, z, share] = cx.carriers[row as usize];
    ForceSource { place: at + Vec3::new(x, y, z), share }
}

/// Acceleration by the forces of a population at a place, in m/s².
#[inline(always)]
pub fn force_pull<R: Real>(cx: &Context<'_>, population: &PopulationBlock, place: Vec3<R>) -> Vec3<R> {
    let mut pull = Vec3::<f32>::ZERO.spread(place.x);
    for number in 0..population.force_count {
        let first = population.first_force_row + number * FORCE_ROWS;
        let [kind, _, first_carrier, carriers] = force_kind(cx, first);
        let [strength, scale, third, _] = force_row(cx, first + 1);
        if kind == FORCE_ATTRACT {
            let at = force_vector(cx, first + 2);
            for carrier in 0..carriers.max(1) {
                let source = force_source(cx, carriers, first_carrier + carrier * CARRIER_ROWS, at);
                if source.share != 0.0 {
                    let toward = source.place.spread(place.x) - place;
                    let squared = (vec3_dot(toward, toward) + scale).max(place.x.all(TINY_SQUARED));
                    let inverse = inverse_sqrt(squared);
                    pull = pull + toward * (((inverse * inverse) * inverse) * (strength * source.share));
                }
            }
        } else if kind == FORCE_NOISE {
            pull = pull + turbulence_in_cells(cx, place * place.x.all(scale)) * place.x.all(strength);
        } else if kind == FORCE_TURN {
            pull = pull + Vec3::new(strength, scale, third).spread(place.x);
        }
    }
    pull
}

/// Velocity after the turns of a step: rotations in Cayley's form, that of Boris (1970).
#[inline(always)]
pub fn force_turn<R: Real>(cx: &Context<'_>, population: &PopulationBlock, velocity: Vec3<R>) -> Vec3<R> {
    let mut turned = velocity;
    for number in 0..population.force_count {
        let first = population.first_force_row + number * FORCE_ROWS;
        let [kind, _, _, _] = force_kind(cx, first);
        if kind == FORCE_TURN {
            let half = turned + vec3_cross(turned, force_vector(cx, first + 2).spread(velocity.x));
            turned = turned + vec3_cross(half, force_vector(cx, first + 3).spread(velocity.x));
        }
    }
    turned
}

/// Place after the swirls of a step, each an exact rotation about its axis, whose ways add up. A carrier's axis is where it ends the step, so
/// that none turns itself.
#[inline(always)]
pub fn force_swirl<R: Real>(cx: &Context<'_>, population: &PopulationBlock, place: Vec3<R>) -> Vec3<R> {
    let mut moved = place;
    for number in 0..population.force_count {
        let first = population.first_force_row + number * FORCE_ROWS;
        let [kind, profile, first_carrier, carriers] = force_kind(cx, first);
        if kind != FORCE_SWIRL {
            continue;
        }
        let [angle, radii_per_m, widening, _] = force_row(cx, first + 1);
        let axis = force_vector(cx, first + 3).spread(place.x);
        let at = force_vector(cx, first + 2);
        for carrier in 0..carriers.max(1) {
            let row = first_carrier + carrier * CARRIER_ROWS;
            let share = force_source(cx, carriers, row, at).share;
            if share == 0.0 {
                continue;
            }
            let apart = place - force_source(cx, carriers, row + 1, at).place.spread(place.x);
            let radial = apart - axis * vec3_dot(apart, axis);
            let squared = vec3_dot(radial, radial) * (radii_per_m * radii_per_m);
            let most = place.x.all(SWIRL_MOST);
            let wanted = swirl_profile(profile, widening, squared) * (angle * share);
            let half = (wanted.min(most).max(-most)) * 0.5;
            // Tangent of half the angle, which is at most a quarter.
            let h2 = half * half;
            let tangent = half * (h2 * (h2 * (h2 * SWIRL_TAN_7 + SWIRL_TAN_5) + SWIRL_TAN_3) + 1.0);
            let gain = reciprocal(tangent * tangent + 1.0) * 2.0;
            let across = axis * tangent;
            let halfway = radial + vec3_cross(across, radial);
            moved = moved + vec3_cross(across, halfway) * gain;
        }
    }
    moved
}

/// Series of the tangent, h^3.
const SWIRL_TAN_3: f32 = 0.333_333_34;
/// Series of the tangent, h^5.
const SWIRL_TAN_5: f32 = 0.133_333_34;
/// Series of the tangent, h^7.
const SWIRL_TAN_7: f32 = 0.053_968_254;
