// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/gust.rs
// Gusts carried along by the mean wind, from a table.
#import bindings
#import wind/row

fn wind_gust(moment: u32, along: f32) -> f32 {
    let x = along * scene.wind.gust_rows_per_m - step_block.moments[moment].gust_offset;
    let k = floor(x);
    let index = bitcast<u32>(i32(k)) & (GUST_ROWS - 1u);
    let row = wind_row(index, scene.wind.first_gust_row);
    return row.x + (x - k) * (row.y - row.x);
}
