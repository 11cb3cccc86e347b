// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/strike.wgsl
//!
//! Contact of a particle with the ground and with solid parts, swept over its step: of the first surface that it strikes it takes an
//! impulse, and goes on with what is left of the step, up to four times. Solid parts are those of leaves, met as a body without extent.
//!
//! Within a step a particle has a constant acceleration, the change of its velocity: between the ends of a straight way it is as far
//! off it as that says. So a bounce has the speed of the moment at which it strikes, whatever the step.

use super::fly::{ParticleFlight, whole_velocity};
use super::record::{MEETS_DIE, MEETS_STICK, POPULATION_LOSS};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::Quat;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot, vec3_select};
use crate::blocks::{NEVER, PopulationBlock};
use crate::context::Context;
use crate::device::flight::body::LeafBody;
use crate::device::flight::strike::{
    MOST_STRIKES, Passage, STRIKE_GAP_M, Strike, deepest_overlap, first_strike, solid_gap,
};
use crate::device::solid::near::solids_cell;
use crate::device::solid::shape::{solid_at, solid_velocity};
use crate::device::terrain::ground::{ground_gradient, ground_surface};

crate::shared_constants! {
    /// Number of the ground in place of a solid part's.
    pub const STRIKE_GROUND: u32 = 0xffff_fffe;
    /// Rounds of the search for the moment at which a particle meets hills.
    pub const GROUND_ROUNDS: u32 = 6;
    /// Most pieces of a way, each no longer than the reach of the lists of solid parts.
    pub const MOST_PIECES: u32 = 64;
    /// Squared speed in m²/s² along a surface below which there is none.
    pub const PARTICLE_STILL_SQUARED: f32 = 1e-12;
    /// Speed in m/s into a surface below which a velocity leads along it: what rounding leaves of one from which the rest was taken.
    pub const ALONG_M_S: f32 = 1e-5;
    /// Overlap in m from which on a particle is pushed out.
    pub const PUSHED_M: f32 = 1e-4;
}

/// A particle at the end of a step in which something was in its way.
#[derive(Clone, Copy, Debug)]
pub struct ParticleContact {
    /// Position and velocity.
    pub flight: ParticleFlight,
    /// Number of hits.
    pub hits: u32,
    /// Number of the part that holds it, [`STRIKE_GROUND`] or [`NEVER`].
    pub held_by: u32,
    /// True if all hits of a step were used.
    pub is_stopped: bool,
    /// True if it dies.
    pub dies: bool,
}

/// Surface of what a particle strikes.
#[derive(Clone, Copy, Debug)]
pub struct StruckSurface {
    /// Unit vector away from it.
    pub normal: Vec3,
    /// Velocity in m/s.
    pub velocity: Vec3,
    /// True if it never moves.
    pub is_still: bool,
}

/// Pose of a body that has no extent.
const NO_TURN: Quat = Quat::new(0.0, 0.0, 0.0, 1.0);

/// A particle as a body without extent.
#[inline(always)]
pub fn particle_body() -> LeafBody {
    LeafBody {
        size_ratio: 1.0,
        inv_size_ratio: 1.0,
        air_per_m: 0.0,
        added_mass: 0.0,
        air_along: 0.0,
        air_across: 0.0,
        half_along_m: 0.0,
        half_across_m: 0.0,
        half_mean_m: 0.0,
        twist_m: 0.0,
        screw_m: 0.0,
        viscous_m_s: 0.0,
        lift_slope_across: 0.0,
        lift_slope_along: 0.0,
        pitch_damping: 0.0,
        edge_drag: 0.0,
        resistance: 0.0,
        inv_inertia: Vec3::ZERO,
        gyration: Vec3::ZERO,
        centroid: Vec3::ZERO,
    }
}

/// Height of a place above the ground in m: hills, water and litter.
#[inline(always)]
pub fn ground_gap<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R {
    place.y - (ground_surface(cx, place.x, place.z) + cx.scene.surface_height_m)
}

/// Share of a way up to the ground; of one that does not end below it, 1 and [`NEVER`].
#[inline(always)]
pub fn ground_strike<R: Real>(cx: &Context<'_>, from: Vec3<R>, way: Vec3<R>) -> Strike<R> {
    let none = from.x.all(0.0);
    let mut high = ground_gap(cx, from);
    let mut low = ground_gap(cx, from + way);
    let ends_below = low.less_than(none.all(-STRIKE_GAP_M));
    let never = low.to_bits().all(NEVER);
    if !ends_below.any() {
        return Strike { number: never, share: none.all(1.0) };
    }
    let begins_above = none.less_than(high);
    let mut before = none;
    let mut after = none.all(1.0);
    let rounds = if cx.scene.has_relief() { GROUND_ROUNDS } else { 1 };
    for _ in 0..rounds {
        let share = before + (after - before) * (high * reciprocal(high - low));
        let gap = if cx.scene.has_relief() { ground_gap(cx, from + way * share) } else { none };
        let is_below = gap.less_than(none);
        after = is_below.select_real(share, after);
        low = is_below.select_real(gap, low);
        before = is_below.select_real(before, share);
        high = is_below.select_real(high, gap);
    }
    let share = begins_above.select_real(before, none);
    Strike {
        number: ends_below.select(never.all(STRIKE_GROUND), never),
        share: ends_below.select_real(share, none.all(1.0)),
    }
}

/// Normal of the ground at a place.
#[inline(always)]
pub fn ground_normal<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> Vec3<R> {
    let [rise_x, rise_z] = ground_gradient(cx, place.x, place.z);
    let up = inverse_sqrt((rise_x * rise_x + rise_z * rise_z) + 1.0);
    Vec3::new(-(rise_x * up), up, -(rise_z * up))
}

/// Surface at a place of the ground, or of a solid part so many seconds into the step.
#[inline(always)]
pub fn struck_surface(cx: &Context<'_>, number: u32, place: Vec3, seconds: f32) -> StruckSurface {
    if number == STRIKE_GROUND {
        return StruckSurface { normal: ground_normal(cx, place), velocity: Vec3::ZERO, is_still: true };
    }
    let solid = solid_at(cx, number, seconds);
    StruckSurface {
        normal: solid_gap(cx, &solid, &particle_body(), NO_TURN, place, 1.0).normal,
        velocity: solid_velocity(&solid, place),
        is_still: cx.scene.solids.mover_count <= number,
    }
}

/// First of ground and solid parts that a straight way strikes. It is walked in pieces, since the lists of solid parts reach only so far.
#[inline(always)]
pub fn particle_strike(cx: &Context<'_>, passage: &Passage) -> Strike {
    let mut strike = ground_strike(cx, passage.from, passage.way);
    if !cx.scene.has_solids() {
        return strike;
    }
    let squared = vec3_dot(passage.way, passage.way).max(TINY_SQUARED);
    let length = squared * inverse_sqrt(squared);
    let pieces =
        (length * reciprocal(cx.scene.solids.reach_m)).floor().min((MOST_PIECES - 1) as f32).to_whole() + 1;
    let part = reciprocal(pieces as f32);
    for piece in 0..pieces {
        let begin = piece as f32 * part;
        if begin < strike.share {
            let from = passage.from + passage.way * begin;
            let there = Passage {
                from,
                way: passage.way * part,
                seconds: passage.seconds + passage.time * begin,
                time: passage.time * part,
                reach_share: 1.0,
            };
            let found = first_strike(cx, &particle_body(), NO_TURN, solids_cell(cx, from), &there);
            let share = begin + found.share * part;
            if found.share < 1.0 && share < strike.share {
                strike = Strike { number: found.number, share };
            }
        }
    }
    strike
}

/// Share of a bent way at which it meets a plane that the straight one meets after `share`: `closing` is the straight way's part towards
/// the plane, `bend` half of the acceleration's times the squared time. A way that begins on the plane and does not leave it meets it there.
///
/// The gap over the share `s` is `closing share - (closing - bend) s - bend s²`; of its two roots the one at which it closes, in the form
/// without a difference of numbers that are nearly equal.
#[inline(always)]
pub fn bent_share<R: Real>(share: R, closing: R, bend: R, leaving: R) -> R {
    let none = share.all(0.0);
    let falling = closing - bend;
    let height = closing * share;
    let squared = (falling * falling + (bend * 4.0) * height).max(none);
    let root = squared * inverse_sqrt(squared.max(none.all(TINY_SQUARED)));
    let rises = falling.less_than(none);
    let over = rises.select_real(root - falling, height * 2.0);
    let under = rises.select_real(bend * 2.0, falling + root);
    let at = none.all(TINY_SQUARED).less_than(under).select_real(over * reciprocal(under), none);
    let begins_there = !(none.less_than(share) | none.less_than(leaving));
    begins_there.select_real(none, at.max(none).min(none.all(1.0)))
}

/// Velocity relative to a surface after a hit: a push along the normal, then friction by Coulomb's law or as a share. `pressing` is the
/// speed that acceleration into the surface gives in the rest of the step, by which it slows down what does not bounce.
#[inline(always)]
pub fn struck_velocity<R: Real>(
    population: &PopulationBlock,
    relative: Vec3<R>,
    normal: Vec3<R>,
    restitution: R,
    pressing: R,
    rest_m_s: f32,
) -> Vec3<R> {
    let none = pressing.all(0.0);
    let leaving = vec3_dot(relative, normal);
    let closing = (-leaving).max(none);
    let push = closing * (restitution + 1.0);
    let rebound = normal * leaving.less_than(none).select_real(closing * restitution, leaving);
    let sliding = relative - normal * leaving;
    let squared = vec3_dot(sliding, sliding);
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    let mut drag = (push + pressing) * population.friction;
    if (population.flags & POPULATION_LOSS) != 0 {
        let share = speed * population.friction;
        drag = speed.less_than(none.all(rest_m_s)).select_real(drag.max(share), share);
    }
    let slides = !squared.less_than(none.all(PARTICLE_STILL_SQUARED)) & drag.less_than(speed);
    vec3_select(slides, rebound + sliding * (none.all(1.0) - inverse * drag), rebound)
}

/// Velocity without what leads into any of the planes that were touched: along the edge of two, none in a corner of three.
#[inline(always)]
pub fn wedged_velocity(velocity: Vec3, first: Vec3, second: Vec3, third: Vec3) -> Vec3 {
    let mut free = velocity - first * vec3_dot(velocity, first).min(0.0);
    if vec3_dot(free, second) < -ALONG_M_S {
        let edge = vec3_cross(first, second);
        let squared = vec3_dot(edge, edge);
        if squared < TINY_SQUARED {
            return Vec3::ZERO;
        }
        free = edge * (vec3_dot(velocity, edge) * reciprocal(squared));
    }
    if vec3_dot(free, third) < -ALONG_M_S {
        return Vec3::ZERO;
    }
    free
}

/// A particle at the end of a step of `time` that begins `seconds` into the step and takes it from `start` to `end` if nothing is in its
/// way. Only for populations that meet anything.
#[inline(always)]
pub fn particle_contact(
    cx: &Context<'_>,
    population: &PopulationBlock,
    start: ParticleFlight,
    end: ParticleFlight,
    seconds: f32,
    time: f32,
) -> ParticleContact {
    let none = Vec3::ZERO;
    let mut contact =
        ParticleContact { flight: end, hits: 0, held_by: NEVER, is_stopped: false, dies: false };
    let mut velocity = start.velocity;
    let mut pull = (end.velocity - start.velocity) * reciprocal(time.max(1e-6));
    let mut passage =
        Passage { from: start.position, way: end.position - start.position, seconds, time, reach_share: 1.0 };
    let rest_m_s = 2.0 * (population.gravity_m_s2.max(0.0) * cx.scene.dt_s);
    let mut first = none;
    let mut second = none;
    let mut third = none;
    let mut is_free = false;
    for _ in 0..MOST_STRIKES {
        let strike = particle_strike(cx, &passage);
        if strike.number == NEVER {
            is_free = true;
            contact.flight.position = passage.from + passage.way * strike.share;
            contact.flight.velocity = velocity + pull * passage.time;
            break;
        }
        let straight = passage.from + passage.way * strike.share;
        let surface =
            struck_surface(cx, strike.number, straight, passage.seconds + passage.time * strike.share);
        let normal = surface.normal;
        if population.meets == MEETS_DIE {
            is_free = true;
            contact.flight.position = straight;
            contact.hits = 1;
            contact.dies = true;
            break;
        }
        let half_square = (0.5 * passage.time) * passage.time;
        let closing = vec3_dot(surface.velocity, normal) * passage.time - vec3_dot(passage.way, normal);
        let bend = -(vec3_dot(pull, normal) * half_square);
        let share = bent_share(strike.share, closing, bend, vec3_dot(velocity - surface.velocity, normal));
        let place = (passage.from + passage.way * share) - pull * (half_square * (share * (1.0 - share)));
        let left = passage.time * (1.0 - share);
        let relative = (velocity + pull * (passage.time * share)) - surface.velocity;
        let is_hit = rest_m_s < -vec3_dot(relative, normal);
        contact.held_by = NEVER;
        passage.from = place;
        passage.seconds += passage.time * share;
        passage.time = left;
        if is_hit {
            contact.hits += 1;
            let kept = struck_velocity(population, relative, normal, population.restitution, 0.0, rest_m_s);
            velocity = kept + surface.velocity;
            passage.way = velocity * left + pull * ((0.5 * left) * left);
        } else {
            // It stays on the surface, which bears it, and slides.
            let into = vec3_dot(pull, normal);
            let sliding = relative - normal * vec3_dot(relative, normal);
            let pushed = relative + (pull - normal * into) * left;
            let pressing = (-(into * left)).max(0.0);
            let kept = struck_velocity(population, pushed, normal, 0.0, pressing, rest_m_s);
            pull = normal * into.max(0.0);
            velocity = kept + surface.velocity;
            passage.from = place + normal * STRIKE_GAP_M;
            passage.way = ((sliding + kept) * 0.5 + surface.velocity) * left + pull * ((0.5 * left) * left);
            if vec3_dot(kept, kept) < PARTICLE_STILL_SQUARED && surface.is_still {
                contact.held_by = strike.number;
            }
        }
        if population.meets == MEETS_STICK {
            is_free = true;
            contact.hits = 1;
            contact.flight = ParticleFlight { position: place, velocity: surface.velocity };
            contact.held_by = if surface.is_still { strike.number } else { NEVER };
            break;
        }
        third = second;
        second = first;
        first = normal;
    }
    if !is_free {
        contact.is_stopped = true;
        contact.held_by = NEVER;
        velocity = wedged_velocity(velocity, first, second, third);
        passage.way = velocity * passage.time;
        let strike = particle_strike(cx, &passage);
        contact.flight = ParticleFlight { position: passage.from + passage.way * strike.share, velocity };
    }
    contact.flight.velocity = whole_velocity(contact.flight.velocity);
    contact
}

/// Place of a particle out of the ground and of the solid part that it overlaps the deepest.
#[inline(always)]
pub fn particle_push(cx: &Context<'_>, place: Vec3, seconds: f32) -> Vec3 {
    let mut pushed = place;
    if cx.scene.has_solids() {
        let deepest = deepest_overlap(cx, &particle_body(), NO_TURN, solids_cell(cx, place), place, seconds);
        if deepest.number != NEVER && deepest.gap.gap_m < -PUSHED_M {
            pushed = place - deepest.gap.normal * deepest.gap.gap_m;
        }
    }
    let below = ground_gap(cx, pushed);
    if below < 0.0 {
        pushed.y -= below;
    }
    pushed
}
