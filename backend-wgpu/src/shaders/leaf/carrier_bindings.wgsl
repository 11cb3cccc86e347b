// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bindings of the kernel that carries leaves on their twigs, besides the blocks, tables and leaf columns.
#import bindings

@group(2) @binding(0) var<uniform> carry_block: CarryBlock;
// The columns BRANCH_TURN, BRANCH_RATE and so on, one after another.
@group(2) @binding(1) var<storage, read> carrier_rows: array<vec4<f32>>;
// Leaves that hang on every segment.
@group(2) @binding(2) var<storage, read_write> leaf_counts: array<atomic<u32>>;
