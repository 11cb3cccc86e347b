// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/mutual.rs
// Attraction of the particles of a population by one another.
#import bindings
#import arith/math
#import arith/vector
#import particle/record

fn mutual_source(number: u32, place: ParticlePlace, motion: ParticleMotion) -> vec4<f32> {
    let half = 0.5 * scene.dt_s;
    let middle = place.position + motion.velocity * half;
    let state = particle_state(place.bits);
    let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
    return vec4<f32>(middle, select(0.0, scene.populations[number].mutual_gm_m3_s2, is_alive));
}

fn mutual_pull(number: u32, pull: vec3<f32>, middle: vec3<f32>, source: vec4<f32>) -> vec3<f32> {
    let toward = source.xyz - middle;
    let inverse = inverse_sqrt(vec3_dot(toward, toward) + scene.populations[number].mutual_softening_m2);
    return pull + toward * (((inverse * inverse) * inverse) * source.w);
}
