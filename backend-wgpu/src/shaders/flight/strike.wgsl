// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/strike.rs
// Contact of a body with solid parts, swept over a substep.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import flight/contact
#import flight/rates
#import solid/distance
#import solid/grid
#import solid/near
#import solid/shape

struct SolidGap {
    gap_m: f32,
    normal: vec3<f32>,
    inner: vec3<f32>,
    arm: vec3<f32>,
}

struct Passage {
    start: vec3<f32>,
    way: vec3<f32>,
    seconds: f32,
    time: f32,
    reach_share: f32,
}

struct Approach {
    start: vec3<f32>,
    way: vec3<f32>,
    reach_share: f32,
}

struct Strike {
    number: u32,
    share: f32,
}

struct Overlap {
    number: u32,
    gap: SolidGap,
}

fn solid_gap(solid: SolidAt, body: LeafBody, pose: vec4<f32>, place: vec3<f32>, reach_share: f32) -> SolidGap {
    let outside = solid_distance(solid, place);
    let inner = quat_rotate_back(pose, outside.normal);
    let nearest = support(body, inner);
    return SolidGap(outside.distance_m - nearest.radius * reach_share, outside.normal, inner, nearest.arm);
}

fn part_strike(
    body: LeafBody,
    pose: vec4<f32>,
    solid: SolidAt,
    approach: Approach,
    before: Strike,
) -> Strike {
    let none = Strike(NEVER, 1.0);
    let is_mesh = (solid.flags & SOLID_GRID) != 0u;
    var rounds = STRIKE_ROUNDS;
    var inv_way = 0.0;
    var half_cell = 0.0;
    if (is_mesh) {
        rounds = MESH_ROUNDS;
        inv_way = inverse_sqrt(max(vec3_dot(approach.way, approach.way), TINY_SQUARED));
        half_cell = 0.5 * grid_cell_m(solid) * inv_way;
    }
    var share = 0.0;
    for (var round = 0u; round < rounds; round += 1u) {
        let place = approach.start + approach.way * share;
        let gap = solid_gap(solid, body, pose, place, approach.reach_share);
        let closing = -vec3_dot(gap.normal, approach.way);
        let is_closing = 0.0 < closing;
        let is_reached = is_closing && gap.gap_m < closing * (before.share - share);
        if (!is_mesh && !is_reached) {
            return none;
        }
        if (is_closing && gap.gap_m < STRIKE_GAP_M) {
            return Strike(before.number, share);
        }
        var advance = half_cell;
        if (is_closing) {
            advance = gap.gap_m * reciprocal(closing);
        }
        if (is_mesh) {
            advance = max(min(advance, half_cell), gap.gap_m * inv_way);
        }
        share = share + advance;
        if (is_mesh && before.share <= share) {
            return none;
        }
    }
    return Strike(select(before.number, NEVER, is_mesh), share);
}

fn body_size_m(body: LeafBody) -> f32 {
    return max(body.half_along_m, body.half_across_m) * body.size_ratio;
}

fn first_strike(body: LeafBody, pose: vec4<f32>, cell: u32, passage: Passage) -> Strike {
    var strike = Strike(NEVER, 1.0);
    let size = body_size_m(body);
    for (var entry = 0u; entry < near_count(cell); entry += 1u) {
        let number = near_solid(cell, entry);
        let solid = solid_at(number, passage.seconds);
        let relative = passage.way - solid.velocity * passage.time;
        let squared = max(vec3_dot(relative, relative), TINY_SQUARED);
        let bound = (solid.bound_m + size) + squared * inverse_sqrt(squared);
        let apart = passage.start - solid.center;
        if (bound * bound < vec3_dot(apart, apart)) {
            continue;
        }
        let approach = Approach(passage.start, relative, passage.reach_share);
        let found = part_strike(body, pose, solid, approach, Strike(number, strike.share));
        if (found.share < strike.share) {
            strike = found;
        }
    }
    return strike;
}

fn struck_motion(
    body: LeafBody,
    motion: FlightMotion,
    solid: SolidAt,
    gap: SolidGap,
    place: vec3<f32>,
    weight_m_s: f32,
) -> FlightMotion {
    let along = solid_velocity(solid, place + quat_rotate(motion.pose, gap.arm));
    let takes_share = (solid.flags & SOLID_LOSS) != 0u;
    let weight = select(0.0, weight_m_s * gap.normal.y, 0.0 < gap.normal.y);
    let surface = Surface(gap.inner, gap.arm, solid.restitution, solid.friction, weight, takes_share);
    let relative = FlightMotion(motion.velocity - along, motion.pose, motion.turning);
    var struck = contact_response(body, relative, surface);
    struck.velocity = struck.velocity + along;
    return struck;
}

fn strike_solids(
    body: LeafBody,
    start: vec3<f32>,
    way: vec3<f32>,
    flown: FlightMotion,
    seconds: f32,
    time: f32,
) -> Contact {
    let cell = solids_cell(start);
    let weight_m_s = time * scene.gravity_m_s2;
    var contact = Contact(start, flown, false);
    var passage = Passage(start, way, seconds, time, STRIKE_REACH);
    for (var number = 0u; number < MOST_STRIKES; number += 1u) {
        let strike = first_strike(body, flown.pose, cell, passage);
        contact.position = passage.start + passage.way * strike.share;
        if (strike.number == NEVER) {
            break;
        }
        passage.start = contact.position;
        passage.seconds = passage.seconds + passage.time * strike.share;
        passage.time = passage.time * (1.0 - strike.share);
        let solid = solid_at(strike.number, passage.seconds);
        let gap = solid_gap(solid, body, flown.pose, contact.position, 1.0);
        contact.motion = struck_motion(body, contact.motion, solid, gap, contact.position, 0.0);
        contact.touches = true;
        passage.way = contact.motion.velocity * passage.time;
    }
    for (var push = 0u; push < MOST_STRIKES + 1u; push += 1u) {
        let deepest = deepest_overlap(body, flown.pose, cell, contact.position, seconds + time);
        if (deepest.number == NEVER) {
            break;
        }
        if (push == MOST_STRIKES) {
            if (deepest.gap.gap_m < -STUCK_M) {
                contact.position = start;
                contact.motion.velocity = vec3<f32>(0.0, 0.0, 0.0);
            }
            break;
        }
        let solid = solid_at(deepest.number, seconds + time);
        let gap = deepest.gap;
        let weight = select(0.0, weight_m_s, push == 0u);
        contact.motion = struck_motion(body, contact.motion, solid, gap, contact.position, weight);
        contact.position = contact.position - gap.normal * gap.gap_m;
        contact.touches = true;
    }
    return contact;
}

fn deepest_overlap(body: LeafBody, pose: vec4<f32>, cell: u32, place: vec3<f32>, seconds: f32) -> Overlap {
    let zero = vec3<f32>(0.0, 0.0, 0.0);
    var deepest = Overlap(NEVER, SolidGap(0.0, zero, zero, zero));
    let size = body_size_m(body);
    for (var entry = 0u; entry < near_count(cell); entry += 1u) {
        let number = near_solid(cell, entry);
        let solid = solid_at(number, seconds);
        let bound = solid.bound_m + size;
        let apart = place - solid.center;
        if (bound * bound < vec3_dot(apart, apart)) {
            continue;
        }
        let gap = solid_gap(solid, body, pose, place, 1.0);
        if (gap.gap_m < deepest.gap.gap_m) {
            deepest = Overlap(number, gap);
        }
    }
    return deepest;
}
