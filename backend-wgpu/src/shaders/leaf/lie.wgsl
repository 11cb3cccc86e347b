// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/lie.rs
// A leaf comes to rest on litter or on the ground that may bear some, and lies down in its own pose.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import flight/body
#import flight/contact
#import leaf/afloat
#import leaf/at_rest
#import leaf/launch
#import leaf/record
#import leaf/settle
#import leaf/strike
#import terrain/ground
#import terrain/litter

fn own_raise(words: vec4<u32>) -> u32 {
    return scene.litter.least_raise + mul_high(words.x, scene.litter.raise_spread + 1u);
}

fn lying_tilt(words: vec4<u32>) -> vec4<f32> {
    let half = sin_cos_turns((own_raise(words) << 16u) >> TILT_SHIFT);
    let axis = sin_cos_turns(words.y);
    return vec4<f32>(half.x * axis.y, 0.0, half.x * axis.x, half.y);
}

fn own_friction(words: vec4<u32>, depth: f32) -> f32 {
    let share = LEAST_FRICTION + unit_float(words.z) * (2.0 - (LEAST_FRICTION + LEAST_FRICTION));
    return contact_friction(depth) * share;
}

fn flatten_to(lean: vec4<f32>, q: vec4<f32>, kept: f32) -> vec4<f32> {
    let back = vec4<f32>(-lean.x, -lean.y, -lean.z, lean.w);
    return quat_multiply(lean, flatten(quat_multiply(back, q), kept));
}

fn reach_down(body: LeafBody, pose: vec4<f32>) -> f32 {
    return support(body, quat_rotate_back(pose, vec3<f32>(0.0, 1.0, 0.0))).radius;
}

fn leaf_rest(leaf: u32) {
    places[leaf].bits = with_state(with_blend(places[leaf].bits & HALF_MASK, 0u), STATE_RESTING);
    drifts[leaf].velocity.y = 0.0;
    drifts[leaf].phase = 0u;
    schedules[leaf].event = recycling_step(leaf);
}

fn leaf_settle_on_litter(leaf: u32) {
    let words = random(scene.seed, identities[leaf].id, STREAM_LYING);
    let position = places[leaf].position;
    let leaning = attitudes[leaf].quaternion;
    let body = body_of(places[leaf].bits, schedules[leaf].size);
    if (is_borne(body, leaning, position)) {
        let held = held_at_rest(leaf);
        if (held.is_firm) {
            leaf_rest_on(leaf, held.at_rest);
            return;
        }
    }
    let slope = ground_slope(position.x, position.z);
    let own = own_friction(words, litter_height(position.x, position.z));
    let loss = own * scene.gravity_m_s2;
    let friction = Friction(loss, 0.5 * reciprocal(loss));
    let slid = slide(drifts[leaf].velocity, scene.dt_s, slope, friction);
    let lean = quat_multiply(ground_lean(slope), lying_tilt(words));
    let lying = flatten_to(lean, leaning, scene.tilt_kept);
    let is_blocked =
        is_inside_solid(body, lying, vec3<f32>(position.x + slid.way.x, position.y, position.z + slid.way.z));
    let pose = select(lying, leaning, is_blocked);
    let x = select(position.x + slid.way.x, position.x, is_blocked);
    let z = select(position.z + slid.way.z, position.z, is_blocked);
    attitudes[leaf].quaternion = pose;
    let rest = lying_height(x, z, reach_down(body, pose));
    let above = (position.y - rest) * scene.tilt_kept;
    let y = select(rest, rest + above, above > SUNK_M);
    places[leaf].position = vec3<f32>(x, y, z);
    let slides = !is_blocked && (slid.velocity.x != 0.0 || slid.velocity.z != 0.0);
    let left = vec3<f32>(slid.velocity.x, 0.0, slid.velocity.z);
    drifts[leaf].velocity = select(vec3<f32>(0.0, 0.0, 0.0), left, slides);
    let steps = select(ground_steps(drifts[leaf].phase) + 1u, 0u, slides);
    drifts[leaf].phase = steps;
    if (steps >= scene.settle_steps && scene.litter.is_living != 0u) {
        leaf_lie_down(leaf, slope, own, words);
    }
}

fn leaf_lie_down(leaf: u32, slope: Slope, friction: f32, words: vec4<u32>) {
    let position = places[leaf].position;
    if (!litter_cell(position.x, position.z).bears) {
        return;
    }
    let raise = own_raise(words);
    let bits = places[leaf].bits;
    let size = with_asymmetry(schedules[leaf].size, random_asymmetry(identities[leaf].id));
    schedules[leaf].size = size;
    let body = body_of(bits, size);
    let pose = attitudes[leaf].quaternion;
    let reach = reach_down(body, pose);
    let volume = lying_units(bits, size, litter_height(position.x, position.z));
    let y = max(position.y, lying_height(position.x, position.z, reach));
    places[leaf].position = vec3<f32>(position.x, y, position.z);
    places[leaf].bits =
        with_litter_change(place_bits(STATE_RESTING, 0u, LYING, leaf_species(bits), volume), CHANGE_ADDED);
    drifts[leaf].phase = wake_speed_word(least_wake_square(leaf_at_rest(body, pose, slope, friction, raise)));
    schedules[leaf].rate = lying_support_word(reach);
    schedules[leaf].heading = lying_word(friction, raise);
    if (floats_at(position.x, position.z)) {
        places[leaf].position.y = ground_bare(position.x, position.z) + (scene.rest_height_m + reach);
        leaf_set_afloat(leaf, words);
    }
}

fn lying_units(bits: u32, size: u32, depth: f32) -> u32 {
    let nominal = scene.bodies[leaf_species(bits)].litter_units;
    let ratio = size_ratio(size);
    return select(0u, u32(min((nominal * ratio) * ratio, f32(HALF_MASK))), depth < LITTER_HIGHEST_M);
}
