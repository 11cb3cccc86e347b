// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Hills: rings of grid around the eye, laid on the land. `terrain_mesh.rs` says why there is no crack.

// Edge of the innermost ring's cells in metres.
const FINEST_M: f32 = 0.5;

@vertex
fn vertex(@location(0) grid: vec2<i32>, @builtin(instance_index) ring: u32) -> Varyings {
    let cell = FINEST_M * f32(1u << ring);
    let half = 0.5 * f32(RING_CELLS) * cell;
    let middle = floor(frame.eye.xz / (2.0 * cell)) * (2.0 * cell);
    var at = middle + vec2<f32>(grid) * cell;
    // Odd vertices glide onto the next ring's grid before they come to it.
    let apart = max(abs(at.x - frame.eye.x), abs(at.y - frame.eye.z)) / half;
    let glide = clamp((apart - 0.6) / (1.0 - 8.0 / f32(RING_CELLS) - 0.6), 0.0, 1.0);
    at -= vec2<f32>(grid & vec2(1)) * (cell * glide);
    var out: Varyings;
    out.world = vec3(at.x, ground_height(at) - SWARD_M, at.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}
