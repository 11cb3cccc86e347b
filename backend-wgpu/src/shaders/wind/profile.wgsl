// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/profile.rs
// Growth of the mean wind and of turbulence with height, from a table.
#import bindings

fn wind_profile(height: f32) -> vec2<f32> {
    let within = min(max(height, PROFILE_LOWEST_M), PROFILE_HIGHEST_M);
    let place = bitcast<u32>(within) - PROFILE_LOWEST_BITS;
    let share = f32(place & ((1u << PROFILE_SHIFT) - 1u)) * PROFILE_UNIT;
    let row = bitcast<vec4<f32>>(tables[scene.wind.first_profile_row + (place >> PROFILE_SHIFT)]);
    return vec2<f32>(row.x + share * (row.y - row.x), row.z + share * (row.w - row.z));
}

fn wind_vertical(height: f32) -> f32 {
    let share = height * scene.wind.vertical_per_m + scene.wind.least_vertical;
    return min(max(share, 0.0), 1.0);
}
