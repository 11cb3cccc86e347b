// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/wind/sample.rs
#import terrain/ground
#import wind/gust
#import wind/profile
#import wind/turbulence
#import wind/vortex

fn wind_at(place: vec3<f32>) -> vec3<f32> {
    let direction_x = environment.wind.mean.x;
    let direction_z = environment.wind.mean.y;
    let along = place.x * direction_x + place.z * direction_z;
    let across = place.z * direction_x - place.x * direction_z;
    let height = place.y - environment.wind.gust.z;
    var above = height;
    if (environment.terrain.w != 0u) {
        above = height - ground_relief(place.x, place.z);
    }
    let mean = (wind_profile(above) * environment.wind.mean.z) * (wind_gust(along) * environment.wind.gust.x + 1.0);
    var turbulence = vec3<f32>(0.0, 0.0, 0.0);
    if (environment.wind.deviation.x != 0.0) {
        turbulence = wind_turbulence(vec3<f32>(along, height, across));
    }
    let u = mean + turbulence.x * environment.wind.deviation.x;
    let v = turbulence.y * environment.wind.deviation.y;
    let w = turbulence.z * environment.wind.deviation.z;
    var air = vec3<f32>(u * direction_x - w * direction_z, v, u * direction_z + w * direction_x);
    for (var index = 0u; index < environment.wind.tables.w; index++) {
        air = air + wind_vortex(index, place);
    }
    return air;
}
