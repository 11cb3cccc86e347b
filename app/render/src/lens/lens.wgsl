// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What every shader after the scene begins with. `Lens` is laid out by `lens_group.rs`.

struct Lens {
    // Width and height of the picture in pixels, and their reciprocals.
    size: vec4<f32>,
    // Where its corner lies in the output, in pixels.
    origin: vec2<f32>,
    // What the log-average becomes; 0 with manual exposure.
    key: f32,
    // How much of the way to a new exposure is gone in this frame.
    adaptation: f32,
    // Multiplier of manual exposure.
    manual: f32,
    // Glare.
    threshold: f32,
    strength: f32,
    // Grading.
    saturation: f32,
    vignette: f32,
    // Gamma or white of the linear tone map and Reinhard's.
    parameter: f32,
    unused_a: f32,
    unused_b: f32,
    // AgX: slope at middle grey, height of the sigmoid below and above it, exponent of its bend.
    agx: vec4<f32>,
    // Depth of field: sharp distance in metres, radius in pixels of a far point's circle, largest radius, near plane in metres.
    focus: vec4<f32>,
}

struct Exposure {
    // Exposed light is light times this.
    multiplier: f32,
    // Binary logarithm of the luminance that the lens has adapted to, and of the picture's log-average.
    adapted: f32,
    measured: f32,
    // 0 before the first frame.
    has_begun: f32,
}

@group(0) @binding(0) var<uniform> lens: Lens;

fn luminance(color: vec3<f32>) -> f32 {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}
