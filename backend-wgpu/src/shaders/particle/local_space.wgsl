// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/local_space.rs
// Motion of particles in the frame of their parent.
#import bindings
#import arith/math
#import arith/vector
#import particle/fly
#import particle/record

struct ParticleFrame {
    start: ParticleFlight,
    end: ParticleFlight,
}

fn parent_frame(place: ParticlePlace, motion: ParticleMotion, start: ParticleStart, birth: u32) -> ParticleFrame {
    let state = particle_state(place.bits);
    let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
    let is_own = bitcast<i32>(birth - motion.birth) >= 0;
    if (!is_alive || !is_own) {
        let still = ParticleFlight(vec3<f32>(0.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 0.0));
        return ParticleFrame(still, still);
    }
    return ParticleFrame(
        ParticleFlight(start.position, start.velocity),
        ParticleFlight(place.position, motion.velocity),
    );
}

fn rest_frame(frame: ParticleFrame, way_s: f32) -> ParticleFrame {
    let velocity = frame.end.velocity;
    return ParticleFrame(ParticleFlight(frame.end.position - velocity * way_s, velocity), frame.end);
}

fn frame_turn(frame: ParticleFrame, turned: vec3<f32>) -> vec3<f32> {
    let before = frame.start.velocity;
    let after = frame.end.velocity;
    let squared_before = vec3_dot(before, before);
    let squared_after = vec3_dot(after, after);
    let least = FRAME_STILL_SQUARED;
    let inverse = inverse_sqrt(max(squared_before, least)) * inverse_sqrt(max(squared_after, least));
    let cross = vec3_cross(before, after) * inverse;
    let near = vec3_dot(before, after) * inverse + 1.0;
    let is_steady = squared_before < least || squared_after < least || near < FRAME_BACK;
    let across = vec3_cross(cross, turned);
    let change = across + vec3_cross(cross, across) * reciprocal(max(near, FRAME_BACK));
    return turned + select(change, vec3<f32>(0.0, 0.0, 0.0), is_steady);
}

fn in_frame(frame: ParticleFrame, flight: ParticleFlight) -> ParticleFlight {
    return ParticleFlight(flight.position, flight.velocity - frame.start.velocity);
}

fn carried_flight(frame: ParticleFrame, flight: ParticleFlight) -> ParticleFlight {
    return ParticleFlight(
        frame.end.position + frame_turn(frame, flight.position - frame.start.position),
        frame.end.velocity + frame_turn(frame, flight.velocity),
    );
}
