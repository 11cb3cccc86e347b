// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/strike.rs
// Leaves and solid parts: what strikes one flies on as a body, what comes to rest on one is held, what lies in the way is pushed.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import flight/body
#import flight/strike
#import leaf/at_rest
#import leaf/launch
#import leaf/lie
#import leaf/record
#import leaf/settle
#import solid/near
#import solid/distance
#import solid/shape
#import terrain/ground

struct Footing {
    is_firm: bool,
    slope: Slope,
    friction: f32,
}

struct HeldAtRest {
    is_firm: bool,
    at_rest: LeafAtRest,
}

fn leaf_strike(leaf: u32, end: vec3<f32>) -> bool {
    if (scene.solids.count == 0u) {
        return false;
    }
    let start = places[leaf].position;
    let cell = solids_cell(start);
    if (near_count(cell) == 0u) {
        return false;
    }
    let bits = places[leaf].bits;
    let size = with_asymmetry(schedules[leaf].size, random_asymmetry(identities[leaf].id));
    let body = body_of(bits, size);
    let pose = attitudes[leaf].quaternion;
    let passage = Passage(start, end - start, 0.0, scene.dt_s, 1.0);
    if (1.0 <= first_strike(body, pose, cell, passage).share) {
        return false;
    }
    let spin = body_spin_words(vec3<f32>(0.0, 0.0, 0.0));
    places[leaf].bits = place_bits(STATE_FALLING, 0u, AERODYNAMIC, leaf_species(bits), 0u);
    drifts[leaf] = Drift((end - start) * scene.inv_dt_s, spin.x);
    schedules[leaf] = Schedule(recycling_step(leaf), spin.y, size, spin.z);
    identities[leaf].fall_time = 0u;
    return true;
}

fn is_inside_solid(body: LeafBody, pose: vec4<f32>, place: vec3<f32>) -> bool {
    if (scene.solids.count == 0u) {
        return false;
    }
    return deepest_overlap(body, pose, solids_cell(place), place, 0.0).number != NEVER;
}

fn solid_footing(body: LeafBody, pose: vec4<f32>, place: vec3<f32>) -> Footing {
    let cell = solids_cell(place);
    var nearest = TOUCH_M;
    var normal = vec3<f32>(0.0, 1.0, 0.0);
    var footing = Footing(false, Slope(0.0, 0.0, 1.0, 1.0), 0.0);
    for (var entry = scene.solids.mover_count; entry < near_count(cell); entry += 1u) {
        let solid = solid_at(near_solid(cell, entry), 0.0);
        let gap = solid_gap(solid, body, pose, place, 1.0);
        if (gap.gap_m < nearest && LEAST_UPWARD < gap.normal.y) {
            nearest = gap.gap_m;
            normal = gap.normal;
            footing.is_firm = true;
            footing.friction = max(solid.friction, LEAST_FRICTION_HELD);
        }
    }
    let inverse = reciprocal(normal.y);
    let x = -(normal.x * inverse);
    let z = -(normal.z * inverse);
    let gain = 1.0 + (x * x + z * z);
    footing.slope = Slope(x, z, gain, reciprocal(gain));
    return footing;
}

fn is_borne(body: LeafBody, pose: vec4<f32>, place: vec3<f32>) -> bool {
    if (scene.solids.count == 0u) {
        return false;
    }
    return ground_rest(place.x, place.z) + (reach_down(body, pose) + TOUCH_M) < place.y;
}

fn held_at_rest(leaf: u32) -> HeldAtRest {
    let pose = attitudes[leaf].quaternion;
    let body = body_of(places[leaf].bits, schedules[leaf].size);
    let footing = solid_footing(body, pose, places[leaf].position);
    let raise = own_raise(random(scene.seed, identities[leaf].id, STREAM_LYING));
    let at_rest = leaf_at_rest(body, pose, footing.slope, footing.friction, raise);
    return HeldAtRest(footing.is_firm, at_rest);
}

fn leaf_rest_on(leaf: u32, at_rest: LeafAtRest) {
    let change = select(CHANGE_NONE, CHANGE_ADDED, scene.litter.is_living != 0u);
    places[leaf].bits = with_litter_change(held_bits(leaf_species(places[leaf].bits)), change);
    drifts[leaf] = Drift(vec3<f32>(0.0, 0.0, 0.0), wake_speed_word(least_wake_square(at_rest)));
    schedules[leaf].rate = lying_support_word(reach_down(at_rest.body, at_rest.pose));
    schedules[leaf].heading = lying_word(at_rest.friction, at_rest.raise);
}

fn comes_upon(mover: SolidAt, number: u32, place: vec3<f32>, size_m: f32) -> bool {
    let way = step_block.movers[number].way_m;
    return 0.0 < way && solid_distance(mover, place).distance_m < size_m + way;
}

fn leaf_push(leaf: u32) -> bool {
    let bits = places[leaf].bits;
    let place = places[leaf].position;
    if (!lies_still(bits) || is_sunk(bits) || !may_meet_movers(place)) {
        return false;
    }
    let body = body_of(bits, schedules[leaf].size);
    let size = body.half_mean_m * body.size_ratio;
    for (var number = 0u; number < scene.solids.mover_count; number += 1u) {
        if (comes_upon(solid_at(number, 0.0), number, place, size)) {
            let spin = body_spin_words(vec3<f32>(0.0, 0.0, 0.0));
            places[leaf].bits = with_litter_change(bits, CHANGE_WOKEN);
            drifts[leaf].phase = spin.x;
            schedules[leaf].rate = spin.y;
            schedules[leaf].heading = spin.z;
            return true;
        }
    }
    return false;
}
