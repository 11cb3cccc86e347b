// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/fly.rs
// A leaf that flies as a body in the air: one step, in as many substeps as its speed and spin ask for.
#import bindings
#import flight/body
#import flight/regime
#import flight/runge_kutta
#import arith/rng
#import leaf/record
#import leaf/settle
#import terrain/ground
#import wind/sample

struct Flight {
    position: vec3<f32>,
    velocity: vec3<f32>,
    pose: vec4<f32>,
    spin: vec3<f32>,
}

struct Regime {
    state: u32,
    bits: u32,
}

fn flight_load(bits: u32, relative: vec3<f32>, spin: vec3<f32>) -> f32 {
    let block = scene.bodies[leaf_species(bits)];
    let squared = max(vec3_dot(relative, relative), TINY_SQUARED);
    let turned = max(vec3_dot(spin, spin), TINY_SQUARED);
    return block.load_per_speed * (squared * inverse_sqrt(squared)) + block.load_per_spin * (turned * inverse_sqrt(turned));
}

fn flight_advance(flight: Flight, bits: u32, size: u32, wind: vec3<f32>) -> Flight {
    let body = body_of(bits, size);
    let relative = flight.velocity - wind;
    let load = flight_load(bits, relative, flight.spin);
    let substeps = substep_count(load);
    let clamped = select(1.0, MAX_SUBSTEPS * reciprocal(load), MAX_SUBSTEPS < load);
    let air = flight.velocity - relative * clamped;
    let time = substeps.share * scene.dt_s;
    var position = flight.position;
    var motion = FlightMotion(flight.velocity, flight.pose, flight.spin * (body.size_ratio * clamped));
    for (var done = 0.0; done < substeps.count; done += 1.0) {
        let step = flight_step(body, motion, air, time);
        position = position + step.way;
        motion = step.end;
    }
    return Flight(position, motion.velocity, motion.pose, motion.turning * body.inv_size_ratio);
}

fn update_regime(flight: Flight, wind: vec3<f32>, state: u32, bits: u32) -> Regime {
    let path = flight.velocity - wind;
    let flow = quat_rotate_back(flight.pose, path);
    let now = step_block.index;
    let rate = scene.ticks_per_step_q16;
    let ticks = mul_q16(now + 1u, rate) - mul_q16(now, rate);
    let idle_timeout = u32(scene.bodies[leaf_species(bits)].idle_timeout_ticks);
    let next = regime_after(state, flow, flight.spin, path, ticks, idle_timeout);
    return Regime(next, with_regime(bits, regime_of(next)));
}

fn flight_of(leaf: u32) -> Flight {
    let drift = drifts[leaf];
    let schedule = schedules[leaf];
    return Flight(
        places[leaf].position,
        drift.velocity,
        attitudes[leaf].quaternion,
        body_spin(drift.phase, schedule.rate, schedule.heading),
    );
}

fn flight_write(leaf: u32, flight: Flight) {
    let spin = body_spin_words(flight.spin);
    places[leaf].position = flight.position;
    drifts[leaf] = Drift(flight.velocity, spin.x);
    attitudes[leaf].quaternion = flight.pose;
    schedules[leaf].rate = spin.y;
    schedules[leaf].heading = spin.z;
}

fn leaf_fly(leaf: u32) {
    if (!flies(places[leaf].bits)) {
        return;
    }
    let start = flight_of(leaf);
    let wind = wind_at(start.position);
    let flight = flight_advance(start, places[leaf].bits, schedules[leaf].size, wind);
    flight_write(leaf, flight);
    let regime = update_regime(flight, wind, regime_state(identities[leaf].fall_time), places[leaf].bits);
    identities[leaf].fall_time = regime.state;
    places[leaf].bits = regime.bits;
    if (ground_met(flight.position)) {
        leaf_land(leaf, start.position);
    }
}
