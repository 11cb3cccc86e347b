// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/strike.wgsl
//!
//! Contact of a body with solid parts, swept over a substep: of the first part that it strikes it takes an impulse there, and goes on
//! with what is left of the substep, up to four times. What then still overlaps a part, since it turned, is pushed out.
//!
//! A body reaches towards a part as far as its outline, an ellipse, does against the normal of the part's nearest point: the plane
//! there separates them while the gap is positive. At edges smaller than a leaf that is early by less than the leaf's own reach.

use super::body::LeafBody;
use super::contact::{Contact, Contacts, Surface, contact_response, flight_contact, support};
use super::rates::FlightMotion;
use crate::arith::lane::Real;
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{Quat, quat_rotate, quat_rotate_back};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::blocks::NEVER;
use crate::context::Context;
use crate::device::solid::distance::solid_distance;
use crate::device::solid::grid::grid_cell_m;
use crate::device::solid::near::{near_count, near_solid, solids_cell};
use crate::device::solid::shape::{SOLID_GRID, SOLID_LOSS, SolidAt, solid_at, solid_velocity};

crate::shared_constants! {
    /// Most parts that a body strikes in a substep, and most that push it out at its end.
    pub const MOST_STRIKES: u32 = 4;
    /// Most rounds of the search for the moment at which it does.
    pub const STRIKE_ROUNDS: u32 = 8;
    /// The same where a mesh is near.
    pub const MESH_ROUNDS: u32 = 16;
    /// Share of its reach up to which a body may come nearer within a substep: turning takes it there, and it is pushed out at the end.
    pub const STRIKE_REACH: f32 = 0.5;
    /// Gap in m below which there is none.
    pub const STRIKE_GAP_M: f32 = 1e-5;
    /// Overlap in m from which on a body that four pushes have not freed goes back to where its substep began.
    pub const STUCK_M: f32 = 1e-3;
}

/// Gap between a body and a solid part.
#[derive(Clone, Copy, Debug)]
pub struct SolidGap {
    /// Gap in m, below zero where they overlap.
    pub gap_m: f32,
    /// Unit vector away from the part.
    pub normal: Vec3,
    /// The same in the body's frame.
    pub inner: Vec3,
    /// Point of the body that is nearest, in its frame.
    pub arm: Vec3,
}

/// Gap between a body at a place, of whose reach a share counts, and a solid part.
#[inline(always)]
pub fn solid_gap(
    cx: &Context<'_>,
    solid: &SolidAt,
    body: &LeafBody,
    pose: Quat,
    place: Vec3,
    reach_share: f32,
) -> SolidGap {
    let from = solid_distance(cx, solid, place);
    let inner = quat_rotate_back(pose, from.normal);
    let (radius, arm) = support(body, inner);
    SolidGap { gap_m: from.distance_m - radius * reach_share, normal: from.normal, inner, arm }
}

/// First solid part that a body strikes.
#[derive(Clone, Copy, Debug)]
pub struct Strike<R: Real = f32> {
    /// Number of the part, or [`NEVER`].
    pub number: R::Word,
    /// Share of the way up to there, or as far as it is free.
    pub share: R,
}

/// A straight way of a body.
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// Place where it begins, in m.
    pub from: Vec3,
    /// Displacement in m.
    pub way: Vec3,
    /// Time into the step at which it begins, in s.
    pub seconds: f32,
    /// Its duration in s.
    pub time: f32,
    /// Share of the body's reach up to which it may come near a part.
    pub reach_share: f32,
}

/// A straight way of a body past a part, as seen from the part.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    /// Place where it begins, in m.
    pub from: Vec3,
    /// Displacement in m.
    pub way: Vec3,
    /// Share of the body's reach up to which it may come near the part.
    pub reach_share: f32,
}

/// Strike of a part, if it comes before a share of the way; its share is 1 if there is none.
///
/// The plane at the nearest point of a convex part bounds all of it, and the way goes on to that plane in every round. Of a mesh it bounds
/// only what is near: beyond half a cell the distance does, and where the rounds do not suffice the way ends without a strike.
#[inline(always)]
pub fn part_strike(
    cx: &Context<'_>,
    body: &LeafBody,
    pose: Quat,
    solid: &SolidAt,
    approach: &Approach,
    before: Strike,
) -> Strike {
    let none = Strike { number: NEVER, share: 1.0 };
    let is_mesh = (solid.flags & SOLID_GRID) != 0;
    let mut rounds = STRIKE_ROUNDS;
    let mut inv_way = 0.0;
    let mut half_cell = 0.0;
    if is_mesh {
        rounds = MESH_ROUNDS;
        inv_way = inverse_sqrt(vec3_dot(approach.way, approach.way).max(TINY_SQUARED));
        half_cell = 0.5 * grid_cell_m(cx, solid) * inv_way;
    }
    let mut share = 0.0;
    for _ in 0..rounds {
        let place = approach.from + approach.way * share;
        let gap = solid_gap(cx, solid, body, pose, place, approach.reach_share);
        let closing = -vec3_dot(gap.normal, approach.way);
        let is_closing = 0.0 < closing;
        let is_reached = is_closing && gap.gap_m < closing * (before.share - share);
        if !is_mesh && !is_reached {
            return none;
        }
        if is_closing && gap.gap_m < STRIKE_GAP_M {
            return Strike { number: before.number, share };
        }
        let mut advance = half_cell;
        if is_closing {
            advance = gap.gap_m * reciprocal(closing);
        }
        if is_mesh {
            advance = advance.min(half_cell).max(gap.gap_m * inv_way);
        }
        share += advance;
        if is_mesh && before.share <= share {
            return none;
        }
    }
    Strike { number: if is_mesh { NEVER } else { before.number }, share }
}

/// Largest distance in m from a body's centre to its outline.
#[inline(always)]
fn body_size_m(body: &LeafBody) -> f32 {
    body.half_along_m.max(body.half_across_m) * body.size_ratio
}

/// First of the parts of a cell that a body strikes on its way: [`NEVER`] if there is none, and then the share of the way that is free.
#[inline(always)]
pub fn first_strike(cx: &Context<'_>, body: &LeafBody, pose: Quat, cell: u32, passage: &Passage) -> Strike {
    let mut strike = Strike { number: NEVER, share: 1.0 };
    let size = body_size_m(body);
    for entry in 0..near_count(cx, cell) {
        let number = near_solid(cx, cell, entry);
        let solid = solid_at(cx, number, passage.seconds);
        let relative = passage.way - solid.velocity * passage.time;
        let squared = vec3_dot(relative, relative).max(TINY_SQUARED);
        let bound = (solid.bound_m + size) + squared * inverse_sqrt(squared);
        let apart = passage.from - solid.center;
        if bound * bound < vec3_dot(apart, apart) {
            continue;
        }
        let approach = Approach { from: passage.from, way: relative, reach_share: passage.reach_share };
        let found = part_strike(cx, body, pose, &solid, &approach, Strike { number, share: strike.share });
        if found.share < strike.share {
            strike = found;
        }
    }
    strike
}

/// Motion of a body after it has struck a part, where its weight gives it a speed downward in a substep.
#[inline(always)]
pub fn struck_motion(
    body: &LeafBody,
    motion: &FlightMotion,
    solid: &SolidAt,
    gap: &SolidGap,
    place: Vec3,
    weight_m_s: f32,
) -> FlightMotion {
    let along = solid_velocity(solid, place + quat_rotate(motion.pose, gap.arm));
    let surface = Surface {
        normal: gap.inner,
        arm: gap.arm,
        restitution: solid.restitution,
        friction: solid.friction,
        weight_m_s: if 0.0 < gap.normal.y { weight_m_s * gap.normal.y } else { 0.0 },
        takes_share: (solid.flags & SOLID_LOSS) != 0,
    };
    let relative =
        FlightMotion { velocity: motion.velocity - along, pose: motion.pose, turning: motion.turning };
    let mut struck = contact_response(body, &relative, &surface);
    struck.velocity = struck.velocity + along;
    struck
}

/// Contacts with solid parts, the ground and the litter on it.
#[derive(Clone, Copy, Debug)]
pub struct AmongSolids;

impl Contacts<f32> for AmongSolids {
    #[inline(always)]
    fn contact(
        cx: &Context<'_>,
        body: &LeafBody,
        from: Vec3,
        way: Vec3,
        motion: FlightMotion,
        seconds: f32,
        time: f32,
    ) -> Contact {
        let struck = strike_solids(cx, body, from, way, motion, seconds, time);
        let mut contact = flight_contact(cx, body, struck.position, struck.motion, time);
        contact.touches |= struck.touches;
        contact
    }
}

/// A body at the end of a substep of `time` that began `seconds` into the step, and took it `way` on in free flight.
#[inline(always)]
pub fn strike_solids(
    cx: &Context<'_>,
    body: &LeafBody,
    from: Vec3,
    way: Vec3,
    flown: FlightMotion,
    seconds: f32,
    time: f32,
) -> Contact {
    let cell = solids_cell(cx, from);
    let weight_m_s = time * cx.scene.gravity_m_s2;
    let mut contact = Contact { position: from, motion: flown, touches: false };
    let mut passage = Passage { from, way, seconds, time, reach_share: STRIKE_REACH };
    for _ in 0..MOST_STRIKES {
        let strike = first_strike(cx, body, flown.pose, cell, &passage);
        contact.position = passage.from + passage.way * strike.share;
        if strike.number == NEVER {
            break;
        }
        passage.from = contact.position;
        passage.seconds += passage.time * strike.share;
        passage.time *= 1.0 - strike.share;
        let solid = solid_at(cx, strike.number, passage.seconds);
        let gap = solid_gap(cx, &solid, body, flown.pose, contact.position, 1.0);
        contact.motion = struck_motion(body, &contact.motion, &solid, &gap, contact.position, 0.0);
        contact.touches = true;
        passage.way = contact.motion.velocity * passage.time;
    }
    for push in 0..MOST_STRIKES + 1 {
        let deepest = deepest_overlap(cx, body, flown.pose, cell, contact.position, seconds + time);
        if deepest.number == NEVER {
            break;
        }
        if push == MOST_STRIKES {
            if deepest.gap.gap_m < -STUCK_M {
                contact.position = from;
                contact.motion.velocity = Vec3::ZERO;
            }
            break;
        }
        let Overlap { number, gap } = deepest;
        let solid = solid_at(cx, number, seconds + time);
        // Its weight presses once.
        let weight = if push == 0 { weight_m_s } else { 0.0 };
        contact.motion = struck_motion(body, &contact.motion, &solid, &gap, contact.position, weight);
        contact.position = contact.position - gap.normal * gap.gap_m;
        contact.touches = true;
    }
    contact
}

/// Solid part that a body overlaps the deepest.
#[derive(Clone, Copy, Debug)]
pub struct Overlap {
    /// Number of the part, or [`NEVER`].
    pub number: u32,
    /// Gap between the two, below zero.
    pub gap: SolidGap,
}

/// Part that a body overlaps the deepest, so many seconds into the step.
#[inline(always)]
pub fn deepest_overlap(
    cx: &Context<'_>,
    body: &LeafBody,
    pose: Quat,
    cell: u32,
    place: Vec3,
    seconds: f32,
) -> Overlap {
    let none = SolidGap { gap_m: 0.0, normal: Vec3::ZERO, inner: Vec3::ZERO, arm: Vec3::ZERO };
    let mut deepest = Overlap { number: NEVER, gap: none };
    let size = body_size_m(body);
    for entry in 0..near_count(cx, cell) {
        let number = near_solid(cx, cell, entry);
        let solid = solid_at(cx, number, seconds);
        let bound = solid.bound_m + size;
        let apart = place - solid.center;
        if bound * bound < vec3_dot(apart, apart) {
            continue;
        }
        let gap = solid_gap(cx, &solid, body, pose, place, 1.0);
        if gap.gap_m < deepest.gap.gap_m {
            deepest = Overlap { number, gap };
        }
    }
    deepest
}
