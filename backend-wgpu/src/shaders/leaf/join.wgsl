// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/join.rs
#import bindings
#import kernel/math
#import kernel/rng
#import leaf/fall
#import leaf/own
#import leaf/release
#import motion/feature
#import wind/sample

fn leaf_join(leaf: u32, glide: Glide) -> Glide {
    let seed = environment.seed;
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
        | (environment.blend_steps << BLEND_SHIFT);
    places[leaf].w = bits;
    let after = own_velocity(bits, words.y, course);
    return Glide(glide.position, glide.drift + (before - after), words.y);
}

fn part_of_step(response: ResponseBlock, length: u32) -> Part {
    let elapsed = (f32(length) * STEP_UNIT) * environment.dt_s;
    let decay = exponential((0.0 - elapsed) * response.inv_time_constant);
    return Part(length, decay, response.time_constant_s);
}

fn leaf_fall_joining(leaf: u32) {
    let place = places[leaf];
    let start = bitcast<vec3<f32>>(place.xyz);
    let response = response_of(place.w);
    let wind = wind_at(start);
    let seed = environment.seed;
    let drift = drifts[leaf];
    var glide = Glide(start, bitcast<vec3<f32>>(drift.xyz), drift.w);
    var done = 0u;
    for (var join = 1u; join < STAGE_COUNT; join++) {
        if (step_block.index >= courses[leaf].x) {
            let identity = identities[leaf];
            let stage = (identity.w >> STAGE_SHIFT) & STAGE_MASK;
            let end = max(done, stage_end(seed, identity.x, identity.z, stage) & HALF_MASK);
            let part = part_of_step(response, end - done);
            glide = glide_part(glide, places[leaf].w, courses[leaf], wind, part);
            glide = leaf_join(leaf, glide);
            done = end;
        }
    }
    let part = part_of_step(response, WHOLE_STEP - done);
    glide_end(leaf, start, glide_part(glide, places[leaf].w, courses[leaf], wind, part));
}
