// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The table of species and of their leaf pictures.

#import gpu/numbers
#import trees/structs
#import leaves/structs

@group(2) @binding(0) var<uniform> table: SpeciesUniform;

// Height of a picture's corners at a stage, lowest and highest, in sides.
fn height_range(layer: u32, stage: f32) -> vec2<f32> {
    let before = min(u32(stage), LAST_BUT_ONE_STAGE);
    let words = table.heights[2u * layer + before / 4u];
    let beyond = table.heights[2u * layer + (before + 1u) / 4u];
    let low = unpack2x16snorm(words[before % 4u]);
    return 2.0 * mix(low, unpack2x16snorm(beyond[(before + 1u) % 4u]), stage - f32(before));
}

// Depth below its middle to which a leaf of some attitude lies, in edges of its picture. Litter gives way a little.
fn lying_depth(layer: u32, stage: f32, attitude: vec4<f32>) -> f32 {
    let is_face_up = rotate(attitude, vec3(0.0, 1.0, 0.0)).y > 0.0;
    let range = select(vec2(0.0), height_range(layer, stage), table.layers[layer].dryness >= 0.0);
    return 0.7 * select(range.y, -range.x, is_face_up);
}
