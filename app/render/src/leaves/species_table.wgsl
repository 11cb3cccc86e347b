// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What is known of the species and of their leaf pictures. `Kinds` is laid out by `leaf_kinds.rs`.

struct Kinds {
    // Species: diameter in metres of the disc with the blade's area; middle of the area from the centre of mass in x and z,
    // in diameters; how much of a dry leaf's folds it has.
    size: array<vec4<f32>, 32>,
    // Layer: edge of its square relative to that diameter; stage of drying, 0 fresh to 5, negative for what does not dry;
    // unused; the variant that has this layer's place in the order from green to brown.
    layer: array<vec4<f32>, 512>,
    // Layer: lowest and highest corner at each of six stages, as signed halves of two sides; two words are unused.
    heights: array<vec4<u32>, 1024>,
    // Variants, number of layers; longest strips of the four levels of detail.
    counts: vec4<u32>,
    strips: vec4<u32>,
}

@group(2) @binding(0) var<uniform> kinds: Kinds;
