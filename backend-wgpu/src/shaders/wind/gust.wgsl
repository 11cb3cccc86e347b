// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/wind/gust.rs
#import bindings

fn wind_gust(along: f32) -> f32 {
    let x = along * environment.wind.gust.y - step_block.offsets.x;
    let k = floor(x);
    let index = bitcast<u32>(i32(k)) & (GUST_ROWS - 1u);
    let row = wind_rows[environment.wind.tables.y + index];
    return row.x + (x - k) * (row.y - row.x);
}
