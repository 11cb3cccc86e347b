// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves with marks, written by `paint.wgsl`, which stand in for their identities: the second word holds the roots of the
// colour in bytes.

fn marked(index: u32, color: vec3<f32>) -> vec3<f32> {
    let root = unpack4x8unorm(identities[index].y).rgb;
    return root * root;
}
