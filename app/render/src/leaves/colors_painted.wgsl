// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves painted by what they do: the colour is the mark's, the picture only shows in its veins and spots.

// Both sides tell the same, with and against the light.
const IS_LEAF: f32 = 0.0;

fn blade_color(image: vec3<f32>, tint: vec3<f32>) -> vec3<f32> {
    return tint * mix(0.75, 1.0, clamp(3.0 * luminance(image), 0.0, 1.0));
}
