// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What the kernel that carries leaves on their twigs sees besides the blocks, wind tables and leaf columns (see
// core/src/leaf/petiole.rs).
#import bindings

struct Carry {
    // First slot of the page.
    first_slot: u32,
    // Segments of the forest, rounded up to whole columns.
    column_rows: u32,
}

@group(1) @binding(0) var<uniform> carry_block: Carry;
// The columns BRANCH_TURN, BRANCH_RATE and so on, one after another.
@group(1) @binding(1) var<storage, read> carrier_rows: array<vec4<f32>>;
// Leaves that hang on every segment.
@group(1) @binding(2) var<storage, read_write> carried: array<atomic<u32>>;
