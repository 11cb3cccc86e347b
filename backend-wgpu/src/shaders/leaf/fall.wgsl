// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/fall.rs
#import bindings
#import kernel/math
#import kernel/quaternion
#import kernel/rng
#import leaf/own
#import leaf/release
#import leaf/settle
#import motion/feature
#import motion/lookup
#import wind/sample

struct Glide {
    position: vec3<f32>,
    drift: vec3<f32>,
    phase: u32,
}

fn glide_part(
    glide: Glide,
    bits: u32,
    course: vec4<u32>,
    wind: vec3<f32>,
    part_q16: u32,
    decay: f32,
    travel: f32,
) -> Glide {
    let end = glide.phase + mul_q16(own_rate(course.y), part_q16);
    let local = motion_advance((bits >> TABLE_SHIFT) & TABLE_MASK, glide.phase, end);
    let own = turn_to_heading(local, course.w >> 16u) * own_scale(course);
    let relative = glide.drift - wind;
    let carried = wind * ((f32(part_q16) * STEP_UNIT) * environment.time.x) + relative * travel;
    return Glide(glide.position + (own + carried), wind + relative * decay, end);
}

fn leaf_join(leaf: u32, glide: Glide) -> Glide {
    let seed = environment.seed.xy;
    let identity = identities[leaf];
    let id = identity.x;
    let old_bits = places[leaf].w;
    let old_course = courses[leaf];
    let before = own_velocity(old_bits, glide.phase, old_course);
    let stage = ((identity.w >> STAGE_SHIFT) & STAGE_MASK) + 1u;
    let species = (old_bits >> SPECIES_SHIFT) & SPECIES_MASK;
    let words = stage_words(seed, id, stage);
    let primitive = transition_next(species, (old_bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK, words.x);
    let ratio = release_ratio(release_size_speed(species, random(seed, id, STREAM_LOOK)));

    identities[leaf].w = (identity.w & ~(STAGE_MASK << STAGE_SHIFT)) | (stage << STAGE_SHIFT);
    let course = vec4<u32>(
        next_event(id, identity.y, identity.z, stage, (identity.w >> SOURCE_SHIFT) & SOURCE_MASK),
        release_rate(species, primitive, ratio),
        old_course.z,
        (words.z & (HALF_MASK << 16u)) | (old_course.w & HALF_MASK),
    );
    courses[leaf] = course;
    let bits = (old_bits & ~((PRIMITIVE_MASK << PRIMITIVE_SHIFT) | (BLEND_MASK << BLEND_SHIFT)))
        | (primitive << PRIMITIVE_SHIFT)
        | (environment.counts.z << BLEND_SHIFT);
    places[leaf].w = bits;
    let after = own_velocity(bits, words.y, course);
    return Glide(glide.position, glide.drift + (before - after), words.y);
}

fn spin_advance(bits: u32, heading: u32) -> u32 {
    let fastest = environment.species[(bits >> SPECIES_SHIFT) & SPECIES_MASK].scales.w;
    let rate = bitcast<i32>(heading << 16u) >> 16u;
    let turn = (rate * bitcast<i32>(fastest)) >> 17u;
    return bits + (bitcast<u32>(turn) << SPIN_SHIFT);
}

fn leaf_fall(leaf: u32) {
    let place = places[leaf];
    let start = bitcast<vec3<f32>>(place.xyz);
    let response = environment.species[(place.w >> SPECIES_SHIFT) & SPECIES_MASK].response;
    let wind = wind_at(start);
    let drift = drifts[leaf];
    var glide = Glide(start, bitcast<vec3<f32>>(drift.xyz), drift.w);
    var done = 0u;
    for (var join = 1u; join < STAGE_COUNT; join++) {
        if (step_block.index.x >= courses[leaf].x) {
            let seed = environment.seed.xy;
            let identity = identities[leaf];
            let stage = (identity.w >> STAGE_SHIFT) & STAGE_MASK;
            let end = stage_end(seed, identity.x, identity.z, stage) & HALF_MASK;
            let part = max(end, done) - done;
            let elapsed = (f32(part) * STEP_UNIT) * environment.time.x;
            let decay = exponential((0.0 - elapsed) * response.w);
            glide = glide_part(
                glide, places[leaf].w, courses[leaf], wind, part, decay, response.z * (1.0 - decay),
            );
            glide = leaf_join(leaf, glide);
            done = max(end, done);
        }
    }
    var decay = response.x;
    var travel = response.y;
    if (done != 0u) {
        let elapsed = (f32(WHOLE_STEP - done) * STEP_UNIT) * environment.time.x;
        decay = exponential((0.0 - elapsed) * response.w);
        travel = response.z * (1.0 - decay);
    }
    let course = courses[leaf];
    let joined = places[leaf].w;
    glide = glide_part(glide, joined, course, wind, WHOLE_STEP - done, decay, travel);

    var bits = spin_advance(joined, course.w);
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
