// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Mean share of sunlight that reaches the air before the eye, column by column of the view: what haze turns into shafts of light.

#import frame/light

@group(2) @binding(0) var shares: texture_storage_3d<rgba8unorm, write>;

// Samples of the sun between two slices.
const STEPS: u32 = 2u;

// Sunlight that reaches a place in the air. The nearest map is finer than a column of the view is wide.
fn sun_at(position: vec3<f32>) -> f32 {
    var lit = 1.0;
    for (var coarser = CASCADES; coarser > 1u; coarser--) {
        let clip = map_place(coarser - 1u, position);
        if max(abs(clip.x), abs(clip.y)) < 0.985 && clip.z > 0.0 && clip.z < 1.0 {
            lit = map_shadow(coarser - 1u, clip, vec2(1.0, 0.0));
        }
    }
    return lit * tree_shade(position).r;
}

@compute @workgroup_size(SHAFT_GROUP_SIZE, SHAFT_GROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= SHAFT_COLUMNS || id.y >= SHAFT_ROWS {
        return;
    }
    let place = (vec2<f32>(id.xy) + 0.5) / vec2(f32(SHAFT_COLUMNS), f32(SHAFT_ROWS)) * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    let direction = normalize(frame.forward + place.x * frame.right + place.y * frame.up);
    var sunlit = 0.0;
    var scattered = 0.0;
    var through = 1.0;
    var from_m = 0.0;
    for (var slice = 0u; slice < SHAFT_SLICES; slice++) {
        let depth = (f32(slice) + 0.5) / f32(SHAFT_SLICES);
        let to_m = SHAFT_REACH_M * depth * depth;
        let length_m = (to_m - from_m) / f32(STEPS);
        for (var step = 0u; step < STEPS; step++) {
            let at = frame.eye_m + direction * (from_m + length_m * (f32(step) + 0.5));
            let height = max(at.y - frame.park_center_m.y, 0.0) * frame.inv_haze_depth_m;
            let kept = exp(-length_m * frame.haze_per_m * exp(-height));
            let share = through * (1.0 - kept);
            sunlit += share * sun_at(at);
            scattered += share;
            through *= kept;
        }
        from_m = to_m;
        textureStore(shares, vec3(id.xy, slice), vec4(sunlit / max(scattered, 1.0e-6), 0.0, 0.0, 0.0));
    }
}
