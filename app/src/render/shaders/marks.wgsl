// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Marks of leaves, written by `paint.wgsl`: where each was, and roots of its colour in bytes.

@group(1) @binding(4) var<storage, read> marks: array<vec4<u32>>;

fn marked(index: u32, color: vec3<f32>) -> vec3<f32> {
    let root = unpack4x8unorm(marks[index].w).rgb;
    return root * root;
}
