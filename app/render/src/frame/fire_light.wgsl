// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light of fires on surfaces. Nothing throws shadows in it.

#import frame/common

@group(1) @binding(10) var<uniform> fire_lights: array<FireLight, MOST_FIRE_LIGHTS>;

// Radiance of a white matt surface at a place that faces `normal`, by all fires.
fn fire_light(position: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    var sum = vec3(0.0);
    for (var index = 0u; index < FIRE_LIGHTS; index++) {
        let fire = fire_lights[index];
        let way = fire.position_m - position;
        let squared = dot(way, way) + fire.spread_m2;
        let facing = max(dot(way, normal) * inverseSqrt(squared), 0.0);
        sum += fire.intensity * (facing / squared);
    }
    return sum * 0.31830989;
}

// The same of a surface that faces every fire.
fn fire_around(position: vec3<f32>) -> vec3<f32> {
    var sum = vec3(0.0);
    for (var index = 0u; index < FIRE_LIGHTS; index++) {
        let fire = fire_lights[index];
        let way = fire.position_m - position;
        sum += fire.intensity / (dot(way, way) + fire.spread_m2);
    }
    return sum * 0.31830989;
}
