// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/profile.rs
// Growth of the mean wind with height, from a table.
#import bindings
#import wind/row

fn wind_profile(height: f32) -> f32 {
    let x = min(max(height * PROFILE_PER_METRE, 0.0), PROFILE_TOP);
    let k = floor(x);
    let row = wind_row(u32(k), scene.wind.first_profile_row);
    return row.x + (x - k) * (row.y - row.x);
}
