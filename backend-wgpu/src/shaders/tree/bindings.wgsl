// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What the kernels that move trees see besides blocks and wind tables (see core/src/tree/record.rs).
#import bindings

// Rows of one level in `forest_order`.
struct Level {
    // First place; number of rows; segments of the forest, rounded up to whole columns; unused.
    rows: vec4<u32>,
}

@group(1) @binding(0) var<uniform> level: Level;
// Constants of every segment, SEGMENT_ROWS rows each, floats as bits.
@group(1) @binding(1) var<storage, read> segment_rows: array<vec4<u32>>;
// Every row of the forest, level by level.
@group(1) @binding(2) var<storage, read> forest_order: array<u32>;
// The columns BRANCH_TURN, BRANCH_RATE and so on, one after another.
@group(1) @binding(3) var<storage, read_write> branch_rows: array<vec4<f32>>;
// Intermediate results of every segment, WORK_ROWS rows each.
@group(1) @binding(4) var<storage, read_write> work_rows: array<vec4<f32>>;
// Leaves that hang on every segment.
@group(1) @binding(5) var<storage, read> bearings: array<u32>;
