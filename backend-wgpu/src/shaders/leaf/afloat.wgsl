// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/afloat.rs
// Leaves on water: they drift before the wind, along the shore, up to other leaves; soaked, they sink.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import flight/body
#import leaf/record
#import leaf/stack
#import leaf/strike
#import leaf/wake
#import terrain/ground
#import terrain/litter

fn floats_at(x: f32, z: f32) -> bool {
    return scene.litter.soaking_steps != 0u && litter_cell(x, z).bears && ground_is_water(x, z);
}

fn soaking_steps(words: vec4<u32>) -> u32 {
    let steps = scene.litter.soaking_steps;
    return (steps >> 1u) + mul_high(words.w, steps) + 1u;
}

fn sinking_speed(words: vec4<u32>) -> f32 {
    return SINKING_M_S + SINKING_SPREAD_M_S * unit_float(words.w << 16u);
}

fn leaf_set_afloat(leaf: u32, words: vec4<u32>) {
    places[leaf].bits = with_afloat(places[leaf].bits);
    let soaked = step_block.index + min(soaking_steps(words), NEVER - step_block.index);
    schedules[leaf].event = min(schedules[leaf].event, soaked);
    drifts[leaf].phase = wake_speed_word(LEAST_WAKES);
    schedules[leaf].rate = lying_support_word(FLOAT_WIND_M);
}

fn along_shore(place: vec3<f32>, velocity: vec3<f32>) -> vec3<f32> {
    let rise = ground_rise(place.x, place.z);
    let steep = rise.x * rise.x + rise.y * rise.y;
    let inverse = inverse_sqrt(max(steep, STILL_SQUARED));
    let x = rise.x * inverse;
    let z = rise.y * inverse;
    let landward = max(velocity.x * x + velocity.z * z, 0.0);
    return vec3<f32>(velocity.x - x * landward, 0.0, velocity.z - z * landward);
}

fn raft_is_ahead(bits: u32, place: vec3<f32>, direction: vec3<f32>) -> bool {
    let reach = 0.5 / LITTER_CELLS_PER_M;
    let ahead = litter_height(place.x + direction.x * reach, place.z + direction.z * reach);
    let here = litter_height(place.x, place.z);
    return RAFT_LAYERS < layers_above(bits, ahead) && layers_above(bits, here - ahead) < RAFT_DROP;
}

fn drifting_velocity(leaf: u32, velocity: vec3<f32>) -> vec3<f32> {
    let place = places[leaf].position;
    var way = velocity;
    let free = drifted(place, way);
    if (!floats_at(free.x, free.z)) {
        way = along_shore(place, way);
    }
    let next = drifted(place, way);
    let squared = way.x * way.x + way.z * way.z;
    if (squared < STILL_SQUARED || !floats_at(next.x, next.z)) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    if (raft_is_ahead(places[leaf].bits, place, way * inverse_sqrt(squared))) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    let body = body_of(places[leaf].bits, schedules[leaf].size);
    if (is_inside_solid(body, attitudes[leaf].quaternion, next)) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    return way;
}

fn leaf_float(leaf: u32, wind: vec3<f32>) -> bool {
    let came = drifts[leaf].velocity;
    let x = wind.x * scene.litter.drift_share;
    let z = wind.z * scene.litter.drift_share;
    let kept = scene.litter.drift_kept;
    let way = drifting_velocity(leaf, vec3<f32>(x + (came.x - x) * kept, 0.0, z + (came.z - z) * kept));
    drifts[leaf].velocity = way;
    return came.x == 0.0 && came.z == 0.0 && (way.x != 0.0 || way.z != 0.0);
}

fn leaf_drift(leaf: u32) {
    if (is_afloat(places[leaf].bits)) {
        let came = drifts[leaf].velocity;
        var way = vec3<f32>(0.0, 0.0, 0.0);
        if (scene.litter.is_calm == 0u) {
            way = drifting_velocity(leaf, came);
        }
        drifts[leaf].velocity = way;
        let squared = max(way.x * way.x + way.z * way.z, STILL_SQUARED);
        let way_m = (squared * inverse_sqrt(squared)) * scene.dt_s;
        let half = (asymmetry(schedules[leaf].size, 0u) * (0.5 * TURN_RAD_PER_M)) * way_m;
        let turned = quat_multiply(vec4<f32>(0.0, half, 0.0, 1.0), attitudes[leaf].quaternion);
        attitudes[leaf].quaternion = quat_normalize(turned);
        return;
    }
    let place = places[leaf].position;
    let lowest = ground_bottom(place.x, place.z);
    let next = place.y + drifts[leaf].velocity.y * scene.dt_s;
    places[leaf].position.y = max(next, lowest);
    if (next <= lowest) {
        drifts[leaf].velocity.y = 0.0;
        drifts[leaf].phase = wake_speed_word(NEVER_WAKES);
    }
}

fn leaf_soak(leaf: u32) {
    let words = random(scene.seed, identities[leaf].id, STREAM_LYING);
    places[leaf].bits = soaked_bits(places[leaf].bits);
    drifts[leaf].velocity = vec3<f32>(0.0, -sinking_speed(words), 0.0);
}
