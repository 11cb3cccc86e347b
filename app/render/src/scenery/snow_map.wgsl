// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Ground that melted snow has soaked, from above: a texel for each cell of snow.

#import scenery/structs

@group(0) @binding(0) var<uniform> snow: SnowUniform;
@group(0) @binding(1) var<storage, read> bed: array<u32>;

// A triangle over the whole map.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let number = u32(pixel.y) * snow.snow_cells.x + u32(pixel.x);
    let soaked = f32(bed[snow.melted_word + number]) * snow.soaked_per_unit;
    return vec4(smoothstep(0.0, 1.0, soaked));
}
