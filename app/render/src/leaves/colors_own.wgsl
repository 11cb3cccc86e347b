// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves in their own colours. `colors_painted.wgsl` stands here instead when they are painted by what they do.

// Whether a blade lets light through and is paler beneath.
const IS_LEAF: f32 = 1.0;

fn blade_color(image: vec3<f32>, tint: vec3<f32>) -> vec3<f32> {
    return image * tint;
}
