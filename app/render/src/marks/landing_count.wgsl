// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Counts the leaves at rest in the cells of a square.

#import leaf_records
#import marks/structs

@group(0) @binding(0) var<uniform> landing: LandingUniform;
@group(0) @binding(1) var<storage, read> places: array<Place>;
@group(0) @binding(2) var<storage, read_write> cells: array<atomic<u32>>;

@compute @workgroup_size(MARKS_GROUP_SIZE)
fn count(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&places) || leaf_state(places[id.x].bits) != STATE_RESTING {
        return;
    }
    let at = floor((places[id.x].position.xz - landing.corner_m) / landing.cell_m);
    if all(at >= vec2(0.0)) && all(at < vec2(f32(landing.cells))) {
        atomicAdd(&cells[u32(at.y) * landing.cells + u32(at.x)], 1u);
    }
}
