// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bark in a shadow map, of the sun or from above.

#import frame/common
#import trees/bark_shape

// Number of the map.
override MAP: u32 = 0u;

@vertex
fn vertex(bark: BarkVertex) -> @builtin(position) vec4<f32> {
    let world = vec4(bark_point(bark).world, 1.0);
    return frame.shadows[MAP] * world;
}
