// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/row.rs
// Two neighbouring values of a wind table.
#import bindings

fn wind_row(index: u32, first: u32) -> vec2<f32> {
    let row = tables[first + index];
    return vec2<f32>(bitcast<f32>(row.x), bitcast<f32>(row.y));
}
