// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/air_cell.rs
// Cells of the air in which leaves meet: the number of a cell along each axis, and a key of all three.
#import prelude

fn cell_floor(cells: f32) -> f32 {
    return floor(min(max(cells, -2097152.0), 2097152.0));
}

fn cell_key(column: u32, layer: u32, line: u32) -> u32 {
    var key = (column * 73856093u) + (layer * 19349663u) + (line * 83492791u);
    key = (key ^ (key >> 16u)) * 0x7feb352du;
    key = (key ^ (key >> 15u)) * 0x846ca68bu;
    return key ^ (key >> 16u);
}
