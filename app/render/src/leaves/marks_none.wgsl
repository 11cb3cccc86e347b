// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves without marks. `marks.wgsl` stands here instead when they are painted by what they do.

fn marked(index: u32, color: vec3<f32>) -> vec3<f32> {
    return color;
}
