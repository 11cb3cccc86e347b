// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/sample.rs
// Velocity of the air at a place: mean flow, gusts, turbulence, vortices, jets, plumes.
#import terrain/ground
#import terrain/litter
#import wind/gust
#import wind/jet
#import wind/plume
#import wind/profile
#import wind/shelter
#import wind/slipstream
#import wind/turbulence
#import wind/vortex

fn wind_at(place: vec3<f32>) -> vec3<f32> {
    return wind_at_moment(MOMENT_NOW, place);
}

fn wind_at_moment(moment: u32, place: vec3<f32>) -> vec3<f32> {
    let direction_x = scene.wind.direction_x;
    let direction_z = scene.wind.direction_z;
    let along = place.x * direction_x + place.z * direction_z;
    let across = place.z * direction_x - place.x * direction_z;
    let height = place.y - scene.ground_height_m;
    let lowest = scene.wind.lowest_surface_m;
    var above = height - max(lowest, 0.0);
    if (scene.has_terrain != 0u) {
        above = height - max(ground_relief(place.x, place.z), lowest);
    }
    if (scene.litter.columns != 0u) {
        above = above_litter(above, place.x, place.z);
    }
    let profile = wind_profile(above);
    var mean = (profile.x * scene.wind.mean_speed_m_s) * (wind_gust(moment, along) * scene.wind.gust_strength + 1.0);
    if (scene.shelter.lack_unit != 0.0) {
        mean = mean * wind_shelter(place.x, above, place.z);
    }
    let deviation = scene.wind.deviation_m_s;
    var turbulence = vec3<f32>(0.0, 0.0, 0.0);
    if (deviation.x != 0.0) {
        turbulence = wind_turbulence(moment, vec3<f32>(along, height, across));
    }
    let u = mean + (turbulence.x * deviation.x) * profile.y;
    let v = (turbulence.y * deviation.y) * wind_vertical(above);
    let w = (turbulence.z * deviation.z) * profile.y;
    var air = vec3<f32>(u * direction_x - w * direction_z, v, u * direction_z + w * direction_x);
    for (var index = 0u; index < step_block.vortex_count; index++) {
        air = air + wind_vortex(moment, index, place);
    }
    for (var index = 0u; index < step_block.jet_count; index++) {
        air = air + wind_jet(moment, index, place, above);
    }
    for (var index = 0u; index < step_block.plume_count; index++) {
        air = air + wind_plume(moment, index, place, profile.y);
    }
    for (var index = 0u; index < step_block.slipstream_count; index++) {
        air = air + wind_slipstream(moment, index, place);
    }
    return air;
}
