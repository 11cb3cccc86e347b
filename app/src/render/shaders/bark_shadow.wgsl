// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bark as the sun sees it.

// Draws into the map of the whole stand instead of the one around the camera.
override WIDE: bool = false;

@vertex
fn vertex(bark: BarkVertex) -> @builtin(position) vec4<f32> {
    let world = vec4(bark_point(bark).world, 1.0);
    if WIDE {
        return frame.wide_projection * world;
    }
    return frame.shadow_projection * world;
}
