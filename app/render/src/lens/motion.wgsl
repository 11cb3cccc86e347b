// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Way over the picture while the shutter is open.

#import lens/motion_structs

@group(1) @binding(0) var<uniform> motion: MotionUniform;

// Half the way in pixels between two places in clip space: before and after the middle of the exposure by as much.
fn way_between(now: vec4<f32>, past: vec4<f32>) -> vec2<f32> {
    // Half of clip space is the tile.
    let way = now.xy / now.w - past.xy / past.w;
    let is_seen = now.w > 0.0 && past.w > 0.0;
    return select(vec2(0.0), 0.25 * motion.open_share * motion.size_px * vec2(way.x, -way.y), is_seen);
}
