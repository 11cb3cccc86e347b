// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/fly.rs
#import bindings
#import flight/body
#import flight/regime
#import flight/runge_kutta
#import kernel/rng
#import leaf/settle
#import terrain/ground
#import wind/sample

struct Flight {
    position: vec3<f32>,
    velocity: vec3<f32>,
    pose: vec4<f32>,
    spin: vec3<f32>,
}

fn flies(bits: u32) -> bool {
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    return (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))) == flying;
}

fn flight_load(bits: u32, relative: vec3<f32>, spin: vec3<f32>) -> f32 {
    let block = environment.bodies[(bits >> SPECIES_SHIFT) & SPECIES_MASK];
    let squared = max(vec3_dot(relative, relative), TINY_SQUARED);
    let turned = max(vec3_dot(spin, spin), TINY_SQUARED);
    return block.load_per_speed * (squared * inverse_sqrt(squared)) + block.load_per_spin * (turned * inverse_sqrt(turned));
}

fn flight_advance(flight: Flight, bits: u32, size: u32, wind: vec3<f32>) -> Flight {
    let body = body_of(bits, size);
    let relative = flight.velocity - wind;
    let load = flight_load(bits, relative, flight.spin);
    let cuts = flight_cuts(load);
    let calm = select(1.0, FLIGHT_CUTS * reciprocal(load), FLIGHT_CUTS < load);
    let air = flight.velocity - relative * calm;
    let time = cuts.y * environment.dt_s;
    var position = flight.position;
    var motion = FlightMotion(flight.velocity, flight.pose, flight.spin * (body.size_ratio * calm));
    for (var done = 0.0; done < cuts.x; done += 1.0) {
        let step = flight_step(body, motion, air, time);
        position = position + step.way;
        motion = step.end;
    }
    return Flight(position, motion.velocity, motion.pose, motion.turning * body.inv_size_ratio);
}

fn flight_told(flight: Flight, wind: vec3<f32>, memory: u32, bits: u32) -> vec2<u32> {
    let path = flight.velocity - wind;
    let flow = quat_rotate_back(flight.pose, path);
    let now = step_block.index;
    let rate = environment.ticks_per_step_q16;
    let ticks = mul_q16(now + 1u, rate) - mul_q16(now, rate);
    let idle_timeout = u32(environment.bodies[(bits >> SPECIES_SHIFT) & SPECIES_MASK].idle_timeout_ticks);
    let told = regime_memory(memory, flow, flight.spin, path, ticks, idle_timeout);
    return vec2<u32>(told, (bits & ~(REGIME_MASK << REGIME_SHIFT)) | (regime_of(told) << REGIME_SHIFT));
}

fn flight_of(leaf: u32) -> Flight {
    let drift = drifts[leaf];
    let course = courses[leaf];
    return Flight(
        bitcast<vec3<f32>>(places[leaf].xyz),
        bitcast<vec3<f32>>(drift.xyz),
        attitudes[leaf],
        bitcast<vec3<f32>>(vec3<u32>(drift.w, course.y, course.w)),
    );
}

fn flight_write(leaf: u32, flight: Flight) {
    let spin = bitcast<vec3<u32>>(flight.spin);
    places[leaf] = vec4<u32>(bitcast<vec3<u32>>(flight.position), places[leaf].w);
    drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(flight.velocity), spin.x);
    attitudes[leaf] = flight.pose;
    courses[leaf] = vec4<u32>(courses[leaf].x, spin.y, courses[leaf].z, spin.z);
}

fn leaf_fly(leaf: u32) {
    if (!flies(places[leaf].w)) {
        return;
    }
    let start = flight_of(leaf);
    let wind = wind_at(start.position);
    let flight = flight_advance(start, places[leaf].w, courses[leaf].z, wind);
    flight_write(leaf, flight);
    let told = flight_told(flight, wind, identities[leaf].z, places[leaf].w);
    identities[leaf].z = told.x;
    places[leaf].w = told.y;
    if (ground_met(flight.position)) {
        leaf_land(leaf, start.position);
    }
}
