// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/strike.rs
// Contact of a particle with the ground and with solid parts, swept over its step.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import flight/strike
#import particle/fly
#import particle/record
#import solid/near
#import solid/shape
#import terrain/ground

const NO_TURN: vec4<f32> = vec4<f32>(0.0, 0.0, 0.0, 1.0);

struct ParticleContact {
    flight: ParticleFlight,
    hits: u32,
    held_by: u32,
    is_stopped: bool,
    dies: bool,
}

struct StruckSurface {
    normal: vec3<f32>,
    velocity: vec3<f32>,
    is_still: bool,
}

fn particle_body() -> LeafBody {
    let none = vec3<f32>(0.0, 0.0, 0.0);
    return LeafBody(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, none, none, none);
}

fn ground_gap(place: vec3<f32>) -> f32 {
    return place.y - (ground_surface(place.x, place.z) + scene.surface_height_m);
}

fn ground_strike(start: vec3<f32>, way: vec3<f32>) -> Strike {
    var high = ground_gap(start);
    var low = ground_gap(start + way);
    if (-STRIKE_GAP_M <= low) {
        return Strike(NEVER, 1.0);
    }
    if (high <= 0.0) {
        return Strike(STRIKE_GROUND, 0.0);
    }
    let has_relief = scene.has_terrain != 0u || scene.litter.columns != 0u;
    var before = 0.0;
    var after = 1.0;
    let rounds = select(1u, GROUND_ROUNDS, has_relief);
    for (var round = 0u; round < rounds; round += 1u) {
        let share = before + (after - before) * (high * reciprocal(high - low));
        var gap = 0.0;
        if (has_relief) {
            gap = ground_gap(start + way * share);
        }
        if (gap < 0.0) {
            after = share;
            low = gap;
        } else {
            before = share;
            high = gap;
        }
    }
    return Strike(STRIKE_GROUND, before);
}

fn ground_normal(place: vec3<f32>) -> vec3<f32> {
    let rise = ground_gradient(place.x, place.z);
    let up = inverse_sqrt((rise.x * rise.x + rise.y * rise.y) + 1.0);
    return vec3<f32>(-(rise.x * up), up, -(rise.y * up));
}

fn struck_surface(number: u32, place: vec3<f32>, seconds: f32) -> StruckSurface {
    if (number == STRIKE_GROUND) {
        return StruckSurface(ground_normal(place), vec3<f32>(0.0, 0.0, 0.0), true);
    }
    let solid = solid_at(number, seconds);
    return StruckSurface(
        solid_gap(solid, particle_body(), NO_TURN, place, 1.0).normal,
        solid_velocity(solid, place),
        scene.solids.mover_count <= number,
    );
}

fn particle_strike(passage: Passage) -> Strike {
    var strike = ground_strike(passage.start, passage.way);
    if (scene.solids.count == 0u) {
        return strike;
    }
    let squared = max(vec3_dot(passage.way, passage.way), TINY_SQUARED);
    let length = squared * inverse_sqrt(squared);
    let pieces = u32(min(floor(length * reciprocal(scene.solids.reach_m)), f32(MOST_PIECES - 1u))) + 1u;
    let part = reciprocal(f32(pieces));
    for (var piece = 0u; piece < pieces; piece += 1u) {
        let begin = f32(piece) * part;
        if (begin < strike.share) {
            let start = passage.start + passage.way * begin;
            let there = Passage(
                start,
                passage.way * part,
                passage.seconds + passage.time * begin,
                passage.time * part,
                1.0,
            );
            let found = first_strike(particle_body(), NO_TURN, solids_cell(start), there);
            let share = begin + found.share * part;
            if (found.share < 1.0 && share < strike.share) {
                strike = Strike(found.number, share);
            }
        }
    }
    return strike;
}

fn bent_share(share: f32, closing: f32, bend: f32, leaving: f32) -> f32 {
    if (share <= 0.0 && leaving <= 0.0) {
        return 0.0;
    }
    let falling = closing - bend;
    let height = closing * share;
    let squared = max(falling * falling + (bend * 4.0) * height, 0.0);
    let root = squared * inverse_sqrt(max(squared, TINY_SQUARED));
    let rises = falling < 0.0;
    let over = select(height * 2.0, root - falling, rises);
    let under = select(falling + root, bend * 2.0, rises);
    let at = select(0.0, over * reciprocal(under), TINY_SQUARED < under);
    return min(max(at, 0.0), 1.0);
}

fn struck_velocity(
    number: u32,
    relative: vec3<f32>,
    normal: vec3<f32>,
    restitution: f32,
    pressing: f32,
    rest_m_s: f32,
) -> vec3<f32> {
    let leaving = vec3_dot(relative, normal);
    let closing = max(-leaving, 0.0);
    let push = closing * (restitution + 1.0);
    let rebound = normal * select(leaving, closing * restitution, leaving < 0.0);
    let sliding = relative - normal * leaving;
    let squared = vec3_dot(sliding, sliding);
    if (squared < PARTICLE_STILL_SQUARED) {
        return rebound;
    }
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    var drag = (push + pressing) * scene.populations[number].friction;
    if ((scene.populations[number].flags & POPULATION_LOSS) != 0u) {
        let share = speed * scene.populations[number].friction;
        drag = select(share, max(drag, share), speed < rest_m_s);
    }
    if (speed <= drag) {
        return rebound;
    }
    return rebound + sliding * (1.0 - inverse * drag);
}

fn wedged_velocity(velocity: vec3<f32>, first: vec3<f32>, second: vec3<f32>, third: vec3<f32>) -> vec3<f32> {
    var free = velocity - first * min(vec3_dot(velocity, first), 0.0);
    if (vec3_dot(free, second) < -ALONG_M_S) {
        let edge = vec3_cross(first, second);
        let squared = vec3_dot(edge, edge);
        if (squared < TINY_SQUARED) {
            return vec3<f32>(0.0, 0.0, 0.0);
        }
        free = edge * (vec3_dot(velocity, edge) * reciprocal(squared));
    }
    if (vec3_dot(free, third) < -ALONG_M_S) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    return free;
}

fn particle_contact(number: u32, start: ParticleFlight, end: ParticleFlight, seconds: f32, time: f32) -> ParticleContact {
    let none = vec3<f32>(0.0, 0.0, 0.0);
    let meets = scene.populations[number].meets;
    var contact = ParticleContact(end, 0u, NEVER, false, false);
    var velocity = start.velocity;
    var pull = (end.velocity - start.velocity) * reciprocal(max(time, 1e-6));
    var passage = Passage(start.position, end.position - start.position, seconds, time, 1.0);
    let rest_m_s = 2.0 * (max(scene.populations[number].gravity_m_s2, 0.0) * scene.dt_s);
    var first = none;
    var second = none;
    var third = none;
    var is_free = false;
    for (var turn = 0u; turn < MOST_STRIKES; turn += 1u) {
        let strike = particle_strike(passage);
        if (strike.number == NEVER) {
            is_free = true;
            contact.flight.position = passage.start + passage.way * strike.share;
            contact.flight.velocity = velocity + pull * passage.time;
            break;
        }
        let straight = passage.start + passage.way * strike.share;
        let surface = struck_surface(strike.number, straight, passage.seconds + passage.time * strike.share);
        let normal = surface.normal;
        if (meets == MEETS_DIE) {
            is_free = true;
            contact.flight.position = straight;
            contact.hits = 1u;
            contact.dies = true;
            break;
        }
        let half_square = (0.5 * passage.time) * passage.time;
        let closing = vec3_dot(surface.velocity, normal) * passage.time - vec3_dot(passage.way, normal);
        let bend = -(vec3_dot(pull, normal) * half_square);
        let share = bent_share(strike.share, closing, bend, vec3_dot(velocity - surface.velocity, normal));
        let place = (passage.start + passage.way * share) - pull * (half_square * (share * (1.0 - share)));
        let left = passage.time * (1.0 - share);
        let relative = (velocity + pull * (passage.time * share)) - surface.velocity;
        let is_hit = rest_m_s < -vec3_dot(relative, normal);
        contact.held_by = NEVER;
        passage.start = place;
        passage.seconds = passage.seconds + passage.time * share;
        passage.time = left;
        if (is_hit) {
            contact.hits = contact.hits + 1u;
            let kept = struck_velocity(number, relative, normal, scene.populations[number].restitution, 0.0, rest_m_s);
            velocity = kept + surface.velocity;
            passage.way = velocity * left + pull * ((0.5 * left) * left);
        } else {
            let into = vec3_dot(pull, normal);
            let sliding = relative - normal * vec3_dot(relative, normal);
            let pushed = relative + (pull - normal * into) * left;
            let pressing = max(-(into * left), 0.0);
            let kept = struck_velocity(number, pushed, normal, 0.0, pressing, rest_m_s);
            pull = normal * max(into, 0.0);
            velocity = kept + surface.velocity;
            passage.start = place + normal * STRIKE_GAP_M;
            passage.way = ((sliding + kept) * 0.5 + surface.velocity) * left + pull * ((0.5 * left) * left);
            if (vec3_dot(kept, kept) < PARTICLE_STILL_SQUARED && surface.is_still) {
                contact.held_by = strike.number;
            }
        }
        if (meets == MEETS_STICK) {
            is_free = true;
            contact.hits = 1u;
            contact.flight = ParticleFlight(place, surface.velocity);
            contact.held_by = select(NEVER, strike.number, surface.is_still);
            break;
        }
        third = second;
        second = first;
        first = normal;
    }
    if (!is_free) {
        contact.is_stopped = true;
        contact.held_by = NEVER;
        velocity = wedged_velocity(velocity, first, second, third);
        passage.way = velocity * passage.time;
        let strike = particle_strike(passage);
        contact.flight = ParticleFlight(passage.start + passage.way * strike.share, velocity);
    }
    contact.flight.velocity = whole_velocity(contact.flight.velocity);
    return contact;
}

fn particle_push(place: vec3<f32>, seconds: f32) -> vec3<f32> {
    var pushed = place;
    if (scene.solids.count != 0u) {
        let deepest = deepest_overlap(particle_body(), NO_TURN, solids_cell(place), place, seconds);
        if (deepest.number != NEVER && deepest.gap.gap_m < -PUSHED_M) {
            pushed = place - deepest.gap.normal * deepest.gap.gap_m;
        }
    }
    let below = ground_gap(pushed);
    if (below < 0.0) {
        pushed.y = pushed.y - below;
    }
    return pushed;
}
