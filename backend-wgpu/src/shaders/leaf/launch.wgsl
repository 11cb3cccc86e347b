// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/launch.rs
// The release of a leaf that flies as a body: its pose before, its asymmetries.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import leaf/record

fn turn_about_y(angle: u32) -> vec4<f32> {
    let half = sin_cos_turns(angle >> 1u);
    return vec4<f32>(0.0, half.x, 0.0, half.y);
}

fn random_pose(words: vec4<u32>) -> vec4<f32> {
    let share = unit_float(words.x);
    let rest = 1.0 - share;
    let turn = sin_cos_turns(words.y);
    let other = sin_cos_turns(words.z);
    let low = rest * inverse_sqrt(max(rest, TINY_SQUARED));
    let high = share * inverse_sqrt(max(share, TINY_SQUARED));
    return vec4<f32>(low * turn.x, low * turn.y, high * other.x, high * other.y);
}

fn hold_pose(species: u32, id: u32) -> vec4<f32> {
    let words = random(scene.seed, id, STREAM_HOLD);
    if (scene.bodies[species].hold_kind == HOLD_RANDOM) {
        return random_pose(words);
    }
    let spread = (bitcast<i32>(scene.bodies[species].hold_spread) * (triangular(words.x) >> 4u)) >> 12u;
    let tilt = bitcast<u32>(bitcast<i32>(scene.bodies[species].hold_tilt) + spread);
    let half = sin_cos_turns((tilt << 16u) >> 1u);
    let tilted = quat_multiply(vec4<f32>(half.x, 0.0, 0.0, half.y), turn_about_y(words.y));
    return quat_multiply(turn_about_y(words.z), tilted);
}

fn leaf_hold(leaf: u32, id: u32) {
    attitudes[leaf].quaternion = hold_pose(leaf_species(places[leaf].bits), id);
    drifts[leaf].phase = 0u;
    schedules[leaf].rate = 0u;
    schedules[leaf].heading = 0u;
}

fn random_asymmetry(id: u32) -> u32 {
    return random(scene.seed, id, STREAM_ASYMMETRY).x & HALF_MASK;
}

fn leaf_launch(leaf: u32, id: u32) {
    schedules[leaf].size = with_asymmetry(schedules[leaf].size, random_asymmetry(id));
    identities[leaf].fall_time = 0u;
}
