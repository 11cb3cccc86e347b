// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Counts the leaves at rest in the cells of a square. `Landing` is laid out by `landing_count.rs`.

struct Landing {
    // Lower corner of the square in x and z, edge of a cell in metres, cells along an edge.
    square: vec4<f32>,
    // Leaves per square metre at the ends of the colours; slots.
    scale: vec4<f32>,
    palette: array<vec4<f32>, 16>,
}

@group(0) @binding(0) var<uniform> landing: Landing;
@group(0) @binding(1) var<storage, read> places: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> cells: array<atomic<u32>>;

@compute @workgroup_size(64)
fn count(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&places) || (places[id.x].w & STATE_MASK) != STATE_RESTING {
        return;
    }
    let place = bitcast<vec3<f32>>(places[id.x].xyz);
    let at = floor((place.xz - landing.square.xy) / landing.square.z);
    if all(at >= vec2(0.0)) && all(at < vec2(landing.square.w)) {
        let edge = u32(landing.square.w);
        atomicAdd(&cells[u32(at.y) * edge + u32(at.x)], 1u);
    }
}
