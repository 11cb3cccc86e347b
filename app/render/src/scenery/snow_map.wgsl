// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// From above, a texel for each cell of snow: share to which melted snow has soaked the ground, and to which leaves that hang above lie under snow.

#import scenery/structs

@group(0) @binding(0) var<uniform> snow: SnowUniform;
@group(0) @binding(1) var<storage, read> bed: array<u32>;
// Places at which the segments above each square metre begin; then of each its row and the area with which it catches snow.
@group(0) @binding(2) var<storage, read> segments: array<u32>;

// A triangle over the whole map.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// Snow on the segments above the square of a cell, over what covers their leaves.
fn on_leaves(cell: vec2<u32>) -> f32 {
    if snow.snow_squares.x == 0u {
        return 0.0;
    }
    let square = (cell.y / snow.square_cells) * snow.snow_squares.x + cell.x / snow.square_cells;
    let first = snow.snow_squares.x * snow.snow_squares.y + 1u;
    var held = 0.0;
    var area = 0.0;
    for (var number = segments[square]; number < segments[square + 1u]; number++) {
        held += f32(bed[snow.branch_word + segments[first + 2u * number]]);
        area += f32(segments[first + 2u * number + 1u]);
    }
    return held * snow.covered_per_unit / max(area, 1.0);
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let number = u32(pixel.y) * snow.snow_cells.x + u32(pixel.x);
    let soaked = f32(bed[snow.melted_word + number]) * snow.soaked_per_unit;
    return vec4(smoothstep(0.0, 1.0, soaked), clamp(on_leaves(vec2<u32>(pixel.xy)), 0.0, 1.0), 0.0, 0.0);
}
