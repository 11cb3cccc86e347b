// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernels that step trees, besides blocks and wind tables (see core/src/tree/record.rs).
#import bindings

@group(1) @binding(0) var<uniform> level: LevelBlock;
@group(1) @binding(1) var<storage, read> segments: array<SegmentConstants>;
// Every row of the forest, level by level.
@group(1) @binding(2) var<storage, read> forest_order: array<u32>;
// The columns BRANCH_TURN, BRANCH_RATE and so on, one after another.
@group(1) @binding(3) var<storage, read_write> branch_rows: array<vec4<f32>>;
// Results of a pass for every segment, WORK_ROWS rows each.
@group(1) @binding(4) var<storage, read_write> work_rows: array<vec4<f32>>;
// Numbers of leaves that hang on the segments.
@group(1) @binding(5) var<storage, read> leaf_counts: array<u32>;
