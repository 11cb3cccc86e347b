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
#import terrain/ground
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

struct Turned {
    bits: u32,
    attitude: vec4<f32>,
}

fn response_of(bits: u32) -> ResponseBlock {
    return environment.responses[(bits >> SPECIES_SHIFT) & SPECIES_MASK];
}

fn glide_part(glide: Glide, bits: u32, course: vec4<u32>, wind: vec3<f32>, part: Part) -> Glide {
    let rate = own_rate(course.y);
    let end = glide.phase + mul_q16(rate, part.length);
    let own = own_advance(bits, course, glide.phase, end);
    let before = glide.drift - wind;
    let after = before * part.decay;
    let spent = on_grid(before * part.tau) - on_grid(after * part.tau);
    let carried = wind * ((f32(part.length) * STEP_UNIT) * environment.dt_s);
    return Glide(glide.position + ((own + spent) + carried), wind + after, end);
}

fn spin_advance(bits: u32, heading: u32, fastest: f32) -> u32 {
    let rate = bitcast<i32>(heading << 16u) >> 16u;
    let turn = (rate * i32(fastest)) >> 17u;
    return bits + (bitcast<u32>(turn) << SPIN_SHIFT);
}

fn attitude_after(leaf: u32, bits: u32, phase: u32, heading: u32) -> Turned {
    let goal = own_orientation(bits, phase, heading);
    let blend = (bits >> BLEND_SHIFT) & BLEND_MASK;
    if (blend == 0u) {
        return Turned(bits, goal);
    }
    let mixed = quat_blend(attitudes[leaf], goal, reciprocal(f32(blend)));
    return Turned(bits - (1u << BLEND_SHIFT), mixed);
}

fn glide_end(leaf: u32, start: vec3<f32>, glide: Glide) {
    let heading = courses[leaf].w;
    let old_bits = places[leaf].w;
    let spun = spin_advance(old_bits, heading, response_of(old_bits).fastest_spin);
    let turned = attitude_after(leaf, spun, glide.phase, heading);
    glide_write(leaf, glide, turned);
    if (ground_met(glide.position)) {
        leaf_land(leaf, start);
    }
}

fn glide_write(leaf: u32, glide: Glide, turned: Turned) {
    attitudes[leaf] = turned.attitude;
    places[leaf] = vec4<u32>(bitcast<vec3<u32>>(glide.position), turned.bits);
    drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(glide.drift), glide.phase);
}

fn glide_step(glide: Glide, bits: u32, course: vec4<u32>, response: ResponseBlock) -> Glide {
    let wind = wind_at(glide.position);
    return glide_part(glide, bits, course, wind, Part(WHOLE_STEP, response.drift_kept, response.time_constant_s));
}

fn leaf_fall(leaf: u32) {
    let place = places[leaf];
    let start = bitcast<vec3<f32>>(place.xyz);
    let drift = drifts[leaf];
    let glide = Glide(start, bitcast<vec3<f32>>(drift.xyz), drift.w);
    glide_end(leaf, start, glide_step(glide, place.w, courses[leaf], response_of(place.w)));
}

fn leaf_glide(leaf: u32, place: vec4<u32>, course: vec4<u32>) -> bool {
    let drift = drifts[leaf];
    let glide = Glide(bitcast<vec3<f32>>(place.xyz), bitcast<vec3<f32>>(drift.xyz), drift.w);
    let response = response_of(place.w);
    let moved = glide_step(glide, place.w, course, response);
    if (ground_met(moved.position)) {
        return false;
    }
    let spun = spin_advance(place.w, course.w, response.fastest_spin);
    glide_write(leaf, moved, attitude_after(leaf, spun, moved.phase, course.w));
    return true;
}
