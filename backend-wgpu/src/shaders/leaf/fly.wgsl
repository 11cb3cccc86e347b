// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/fly.rs
// A leaf that flies as a body in the air: one step, in as many substeps as its speed and spin ask for.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import flight/contact
#import flight/regime
#import flight/runge_kutta
#import flight/strike
#import arith/rng
#import leaf/at_rest
#import leaf/lie
#import leaf/record
#import leaf/settle
#import leaf/strike
#import solid/near
#import terrain/ground
#import terrain/litter
#import wind/pile_shadow
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

struct Flown {
    flight: Flight,
    is_calm: bool,
    is_wet: bool,
}

fn longest_way_squared(velocity: vec3<f32>, wind: vec3<f32>) -> f32 {
    let slip = velocity - wind;
    let relative = max(vec3_dot(slip, slip), TINY_SQUARED);
    let carried = max(vec3_dot(wind, wind), TINY_SQUARED);
    let speed = (relative * inverse_sqrt(relative) + carried * inverse_sqrt(carried)) + FLIGHT_GAIN_M_S;
    let way = speed * scene.dt_s;
    return way * way;
}

fn flight_load(bits: u32, relative: vec3<f32>, spin: vec3<f32>) -> f32 {
    let block = scene.bodies[leaf_species(bits)];
    let squared = max(vec3_dot(relative, relative), TINY_SQUARED);
    let turned = max(vec3_dot(spin, spin), TINY_SQUARED);
    return block.load_per_speed * (squared * inverse_sqrt(squared)) + block.load_per_spin * (turned * inverse_sqrt(turned));
}

fn bounded_turning(bits: u32, body: LeafBody, substeps: Substeps, turning: vec3<f32>) -> vec3<f32> {
    let per_spin = scene.bodies[leaf_species(bits)].load_per_spin;
    let most = (substeps.count * body.size_ratio) * reciprocal(per_spin);
    let squared = max(vec3_dot(turning, turning), TINY_SQUARED);
    let share = most * inverse_sqrt(squared);
    return turning * min(share, 1.0);
}

fn flight_advance(flight: Flight, bits: u32, size: u32, wind: vec3<f32>, is_among_solids: bool) -> Flown {
    let body = body_of(bits, size);
    let relative = flight.velocity - wind;
    let load = flight_load(bits, relative, flight.spin);
    let substeps = substep_count(load);
    let clamped = select(1.0, MAX_SUBSTEPS * reciprocal(load), MAX_SUBSTEPS < load);
    let air = flight.velocity - relative * clamped;
    let time = substeps.share * scene.dt_s;
    var position = flight.position;
    var motion = FlightMotion(flight.velocity, flight.pose, flight.spin * (body.size_ratio * clamped));
    var touches = false;
    for (var done = 0.0; done < substeps.count; done += 1.0) {
        let step = flight_step(body, motion, air, time);
        let start = position;
        position = position + step.way;
        motion = step.end;
        if (scene.litter.columns != 0u) {
            if (is_among_solids) {
                let struck = strike_solids(body, start, step.way, motion, time * done, time);
                position = struck.position;
                motion = struck.motion;
                touches = touches || struck.touches;
            }
            let contact = flight_contact(body, position, motion, time);
            position = contact.position;
            motion = contact.motion;
            motion.turning = bounded_turning(bits, body, substeps, motion.turning);
            touches = touches || contact.touches;
        }
    }
    let end = Flight(position, motion.velocity, motion.pose, motion.turning * body.inv_size_ratio);
    let swing = end.spin * ((body.half_mean_m * body.size_ratio) * 0.5);
    let energy = vec3_dot(end.velocity, end.velocity) + vec3_dot(swing, swing);
    var is_wet = false;
    if (scene.litter.soaking_steps != 0u && touches) {
        is_wet = ground_is_water(position.x, position.z);
    }
    return Flown(end, touches && energy < scene.litter.rest_m2_s2, is_wet);
}

fn update_regime(flight: Flight, wind: vec3<f32>, state: u32, bits: u32, size: u32) -> Regime {
    let path = flight.velocity - wind;
    let flow = quat_rotate_back(flight.pose, path);
    let now = step_block.index;
    let rate = scene.ticks_per_step_q16;
    let ticks = mul_q16(now + 1u, rate) - mul_q16(now, rate);
    let species = leaf_species(bits);
    let idle_timeout = u32(scene.bodies[species].idle_timeout_ticks);
    let next = regime_after(state, flow, flight.spin, path, ticks, idle_timeout);
    let reach_m = max(scene.bodies[species].half_along_m, scene.bodies[species].half_across_m) * size_ratio(size);
    return Regime(next, with_regime(bits, regime_in_spin(regime_of(next), flow, flight.spin, reach_m)));
}

fn count_calm_steps(bits: u32, is_calm: bool, is_wet: bool) -> u32 {
    if (scene.litter.columns == 0u) {
        return bits;
    }
    let calm = select(0u, touch_steps(bits) + 1u, is_calm);
    return with_touch_steps(bits, select(calm, scene.settle_steps, is_wet));
}

fn flight_ends(bits: u32, position: vec3<f32>) -> bool {
    if (scene.litter.columns == 0u) {
        return ground_met(position);
    }
    return touch_steps(bits) >= scene.settle_steps;
}

fn leaf_end_flight(leaf: u32, start: vec3<f32>) {
    if (scene.litter.columns == 0u) {
        leaf_land(leaf, start);
        return;
    }
    let before = attitudes[leaf].quaternion;
    let body = body_of(places[leaf].bits, schedules[leaf].size);
    if (is_borne(body, before, places[leaf].position)) {
        let held = held_at_rest(leaf);
        let air = wind_at(places[leaf].position);
        if (!held.is_firm || slides_down(held.at_rest) || wind_moves(held.at_rest, air, REST_SHARE_SQUARED)) {
            places[leaf].bits = with_touch_steps(places[leaf].bits, 0u);
        } else {
            leaf_rest(leaf);
        }
        return;
    }
    let x = places[leaf].position.x;
    let z = places[leaf].position.z;
    if (scene.litter.soaking_steps != 0u && ground_is_water(x, z)) {
        leaf_rest(leaf);
        return;
    }
    let words = random(scene.seed, identities[leaf].id, STREAM_LYING);
    let slope = ground_slope(x, z);
    let lean = quat_multiply(ground_lean(slope), lying_tilt(words));
    let pose = flatten_to(lean, before, 0.0);
    let friction = own_friction(words, litter_height(x, z));
    let open_wind = wind_at(vec3<f32>(x, ground_rest(x, z) + reach_down(body, pose), z));
    let wind = wind_behind_piles(x, z, open_wind);
    let at_rest = leaf_at_rest(body, pose, slope, friction, own_raise(words));
    if (wind_moves(at_rest, wind, REST_SHARE_SQUARED)) {
        places[leaf].bits = with_touch_steps(places[leaf].bits, 0u);
    } else {
        leaf_rest(leaf);
    }
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
    let is_among_solids = scene.solids.count != 0u &&
        may_meet_solids(start.position, longest_way_squared(start.velocity, wind));
    let size = schedules[leaf].size;
    let flown = flight_advance(start, places[leaf].bits, size, wind, is_among_solids);
    flight_write(leaf, flown.flight);
    let before = regime_state(identities[leaf].fall_time);
    let regime = update_regime(flown.flight, wind, before, places[leaf].bits, size);
    identities[leaf].fall_time = regime.state;
    let bits = count_calm_steps(regime.bits, flown.is_calm, flown.is_wet);
    places[leaf].bits = bits;
    if (flight_ends(bits, flown.flight.position)) {
        leaf_end_flight(leaf, start.position);
    }
}
