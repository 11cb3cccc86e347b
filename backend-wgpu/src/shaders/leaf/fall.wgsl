// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/fall.rs
#import bindings
#import kernel/math
#import kernel/quaternion
#import kernel/rng
#import leaf/own
#import leaf/settle
#import motion/lookup
#import wind/sample

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

fn glide_part(glide: Glide, bits: u32, course: vec4<u32>, wind: vec3<f32>, part: Part) -> Glide {
    let end = glide.phase + mul_q16(own_rate(course.y), part.length);
    let own = own_advance(bits, course, glide.phase, end);
    let before = glide.drift - wind;
    let after = before * part.decay;
    let spent = on_grid(before * part.tau) - on_grid(after * part.tau);
    let carried = wind * ((f32(part.length) * STEP_UNIT) * environment.time.x);
    return Glide(glide.position + ((own + spent) + carried), wind + after, end);
}

fn spin_advance(bits: u32, heading: u32) -> u32 {
    let fastest = environment.species[(bits >> SPECIES_SHIFT) & SPECIES_MASK].scales.w;
    let rate = bitcast<i32>(heading << 16u) >> 16u;
    let turn = (rate * bitcast<i32>(fastest)) >> 17u;
    return bits + (bitcast<u32>(turn) << SPIN_SHIFT);
}

fn glide_end(leaf: u32, start: vec3<f32>, glide: Glide) {
    let course = courses[leaf];
    var bits = spin_advance(places[leaf].w, course.w);
    var attitude = own_orientation(bits, glide.phase, course.w);
    let blend = (bits >> BLEND_SHIFT) & BLEND_MASK;
    if (blend != 0u) {
        attitude = quat_blend(attitudes[leaf], attitude, reciprocal(f32(blend)));
        bits -= 1u << BLEND_SHIFT;
    }
    attitudes[leaf] = attitude;
    places[leaf] = vec4<u32>(bitcast<vec3<u32>>(glide.position), bits);
    drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(glide.drift), glide.phase);
    if (glide.position.y < environment.ground.y) {
        leaf_land(leaf, start);
    }
}

fn leaf_fall(leaf: u32) {
    let place = places[leaf];
    let start = bitcast<vec3<f32>>(place.xyz);
    let response = environment.species[(place.w >> SPECIES_SHIFT) & SPECIES_MASK].response;
    let wind = wind_at(start);
    let drift = drifts[leaf];
    let glide = Glide(start, bitcast<vec3<f32>>(drift.xyz), drift.w);
    let part = Part(WHOLE_STEP, response.x, response.z);
    glide_end(leaf, start, glide_part(glide, place.w, courses[leaf], wind, part));
}
