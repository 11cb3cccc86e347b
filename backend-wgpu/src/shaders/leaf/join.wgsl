// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/join.rs
// Joins between the stages of a fall: the drift takes up the difference of the motions' velocities.
#import bindings
#import arith/math
#import arith/rng
#import leaf/fall
#import leaf/own
#import leaf/record
#import leaf/release
#import leaf/strike
#import motion/feature
#import wind/packed

fn leaf_join(leaf: u32, glide: Glide) -> Glide {
    let seed = scene.seed;
    let identity = identities[leaf];
    let id = identity.id;
    let old_bits = places[leaf].bits;
    let old = schedules[leaf];
    let before = own_velocity(old_bits, glide.phase, motion_params(old));
    let stage = leaf_stage(identity.appearance) + 1u;
    let species = leaf_species(old_bits);
    let words = stage_words(seed, id, stage);
    let primitive = transition_next(species, leaf_primitive(old_bits), words.x);
    let ratio = release_ratio(release_size_speed(species, random(seed, id, STREAM_TRAITS)));

    identities[leaf].appearance = with_stage(identity.appearance, stage);
    let schedule = Schedule(
        next_event(id, identity.release, identity.fall_time, stage, leaf_source(identity.appearance)),
        release_rate(species, primitive, ratio),
        old.size,
        heading_word(words.z >> 16u, old.heading),
    );
    schedules[leaf] = schedule;
    let bits = with_blend(with_primitive(old_bits, primitive), scene.blend_steps);
    places[leaf].bits = bits;
    let after = own_velocity(bits, words.y, motion_params(schedule));
    return Glide(glide.position, glide.drift + (before - after), words.y);
}

fn part_of_step(response: Response, length: u32) -> Part {
    let elapsed = (f32(length) * STEP_UNIT) * scene.dt_s;
    let decay = exponential((-elapsed) * response.inv_time_constant);
    return Part(length, decay, response.time_constant_s);
}

fn leaf_fall_joining(leaf: u32) {
    let place = places[leaf];
    let start = place.position;
    let response = response_of(place.bits);
    let seed = scene.seed;
    var glide = glide_of(place, drifts[leaf]);
    let wind = wind_unpack(airs[leaf]);
    var done = 0u;
    for (var join = 1u; join < STAGE_COUNT; join++) {
        if (step_block.index >= schedules[leaf].event) {
            let identity = identities[leaf];
            let stage = leaf_stage(identity.appearance);
            let end = max(done, stage_end(seed, identity.id, identity.fall_time, stage) & HALF_MASK);
            let part = part_of_step(response, end - done);
            glide = glide_part(glide, places[leaf].bits, motion_params(schedules[leaf]), wind, part);
            glide = leaf_join(leaf, glide);
            done = end;
        }
    }
    let part = part_of_step(response, WHOLE_STEP - done);
    let bits = places[leaf].bits;
    let schedule = schedules[leaf];
    let moved = glide_part(glide, bits, motion_params(schedule), wind, part);
    if (leaf_strike(leaf, moved.position)) {
        return;
    }
    glide_end(leaf, moved, bits, schedule.heading);
    if (ground_met(moved.position)) {
        leaf_land(leaf, start);
    }
}
