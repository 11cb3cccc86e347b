// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/air.rs
// The air that a falling leaf meets, sampled once for an interval of a few steps, in its middle.
#import bindings
#import leaf/fall
#import leaf/record
#import wind/packed
#import wind/sample

fn air_sample(position: vec3<f32>, drift: vec3<f32>, time_constant_s: f32) -> vec2<u32> {
    let descent = time_constant_s * scene.gravity_m_s2;
    let velocity = vec3<f32>(drift.x, drift.y - descent, drift.z);
    let way = velocity * scene.wind.half_interval_s;
    return wind_pack(wind_at_moment(MOMENT_MIDDLE, position + way));
}

fn leaf_sample_air(leaf: u32) {
    let place = places[leaf];
    if (leaf_state(place.bits) == STATE_FALLING && !flies(place.bits)) {
        airs[leaf] = air_sample(place.position, drifts[leaf].velocity, response_of(place.bits).time_constant_s);
    }
}
