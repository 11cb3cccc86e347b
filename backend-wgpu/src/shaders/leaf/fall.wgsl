// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/fall.rs
// A leaf in the air: its own motion from the tables, and a drift that relaxes towards the wind.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import arith/vector
#import leaf/own
#import leaf/record
#import leaf/settle
#import leaf/strike
#import motion/lookup
#import solid/near
#import terrain/ground
#import wind/packed

struct Glide {
    position: vec3<f32>,
    drift: vec3<f32>,
    phase: u32,
}

struct Part {
    length: u32,
    decay: f32,
    tau: f32,
}

struct Response {
    drift_kept: f32,
    fastest_spin: f32,
    time_constant_s: f32,
    inv_time_constant: f32,
}

struct Turned {
    bits: u32,
    attitude: vec4<f32>,
}

fn response_of(bits: u32) -> Response {
    let vector = leaf_species(bits) >> 2u;
    let lane = leaf_species(bits) & 3u;
    return Response(
        scene.responses.drift_kept[vector][lane],
        scene.responses.fastest_spin[vector][lane],
        scene.responses.time_constant_s[vector][lane],
        scene.responses.inv_time_constant[vector][lane],
    );
}

fn glide_of(place: Place, drift: Drift) -> Glide {
    return Glide(place.position, drift.velocity, drift.phase);
}

fn felt_drift(drift: vec3<f32>) -> vec3<f32> {
    let twice = bitcast<vec3<u32>>(drift) << vec3<u32>(1u);
    return select(drift, vec3<f32>(0.0), twice < vec3<u32>(SLOWEST_DRIFT_TWICE));
}

fn glide_part(glide: Glide, bits: u32, params: MotionParams, wind: vec3<f32>, part: Part) -> Glide {
    let rate = own_rate(params.rate);
    let end = glide.phase + mul_q16(rate, part.length);
    let own = own_advance(bits, params, glide.phase, end);
    let before = felt_drift(glide.drift - wind);
    let after = before * part.decay;
    let spent = on_grid(before * part.tau) - on_grid(after * part.tau);
    let carried = wind * ((f32(part.length) * STEP_UNIT) * scene.dt_s);
    return Glide(glide.position + ((own + spent) + carried), wind + after, end);
}

fn spin_advance(bits: u32, heading: u32, fastest: f32) -> u32 {
    let turn = (bitcast<i32>(spin_rate(heading)) * i32(fastest)) >> 17u;
    return turn_spin(bits, bitcast<u32>(turn));
}

fn attitude_after(leaf: u32, bits: u32, phase: u32, heading: u32) -> Turned {
    let goal = own_orientation(bits, phase, heading);
    let steps_left = blend_steps_left(bits);
    if (steps_left == 0u) {
        return Turned(bits, goal);
    }
    let mixed = quat_blend(attitudes[leaf].quaternion, goal, reciprocal(f32(steps_left)));
    return Turned(count_down_blend(bits, true), mixed);
}

fn glide_end(leaf: u32, glide: Glide, bits: u32, heading: u32) {
    let spun = spin_advance(bits, heading, response_of(bits).fastest_spin);
    let turned = attitude_after(leaf, spun, glide.phase, heading);
    attitudes[leaf].quaternion = turned.attitude;
    places[leaf] = Place(glide.position, turned.bits);
    drifts[leaf] = Drift(glide.drift, glide.phase);
}

fn glide_step(glide: Glide, bits: u32, params: MotionParams, response: Response, wind: vec3<f32>) -> Glide {
    let part = Part(WHOLE_STEP, response.drift_kept, response.time_constant_s);
    return glide_part(glide, bits, params, wind, part);
}

fn leaf_fall_aloft(leaf: u32, place: Place, schedule: Schedule) -> bool {
    let glide = glide_of(place, drifts[leaf]);
    let wind = wind_unpack(airs[leaf]);
    let moved = glide_step(glide, place.bits, motion_params(schedule), response_of(place.bits), wind);
    let way = moved.position - glide.position;
    let way_squared = vec3_dot(way, way);
    let is_near = scene.solids.count != 0u && may_meet_solids(glide.position, way_squared);
    if (ground_met(moved.position) || is_near) {
        return false;
    }
    glide_end(leaf, moved, place.bits, schedule.heading);
    return true;
}

fn leaf_fall(leaf: u32, place: Place, schedule: Schedule) {
    let glide = glide_of(place, drifts[leaf]);
    let wind = wind_unpack(airs[leaf]);
    let moved = glide_step(glide, place.bits, motion_params(schedule), response_of(place.bits), wind);
    if (leaf_strike(leaf, moved.position)) {
        return;
    }
    glide_end(leaf, moved, place.bits, schedule.heading);
    if (ground_met(moved.position)) {
        leaf_land(leaf, place.position);
    }
}
