// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/runge_kutta.rs
// The classical fourth-order Runge-Kutta step of a body, and the number of substeps of a step.
#import flight/body
#import flight/rates
#import arith/quaternion

struct FlightStep {
    way: vec3<f32>,
    end: FlightMotion,
}

struct Substeps {
    count: f32,
    share: f32,
}

fn flight_stage(motion: FlightMotion, rates: FlightMotion, time: f32) -> FlightMotion {
    return FlightMotion(
        motion.velocity + rates.velocity * time,
        motion.pose + rates.pose * time,
        motion.turning + rates.turning * time,
    );
}

fn flight_sum(a: FlightMotion, b: FlightMotion) -> FlightMotion {
    return FlightMotion(a.velocity + b.velocity, a.pose + b.pose, a.turning + b.turning);
}

fn flight_step(body: LeafBody, motion: FlightMotion, wind: vec3<f32>, time: f32) -> FlightStep {
    let half = time * 0.5;
    let k1 = flight_rates(body, motion, wind);
    let k2 = flight_rates(body, flight_stage(motion, k1, half), wind);
    let k3 = flight_rates(body, flight_stage(motion, k2, half), wind);
    let k4 = flight_rates(body, flight_stage(motion, k3, time), wind);
    let middle = flight_sum(k2, k3);
    let all = flight_sum(flight_sum(k1, k4), flight_sum(middle, middle));
    let sixth = time * SIXTH;
    var end = flight_stage(motion, all, sixth);
    end.pose = quat_normalize(end.pose);
    let way = motion.velocity * time + (k1.velocity + middle.velocity) * (time * sixth);
    return FlightStep(way, end);
}

fn substep_count(load: f32) -> Substeps {
    var count = 1.0;
    var share = 1.0;
    for (var halving = 0u; halving < MAX_HALVINGS; halving++) {
        let more = count < load;
        count = select(count, count + count, more);
        share = select(share, share * 0.5, more);
    }
    return Substeps(count, share);
}
