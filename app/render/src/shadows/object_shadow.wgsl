// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Objects and those who walk in a shadow map, of the sun or from above.

#import frame/common
#import objects/object_shape

// Number of the map.
override MAP: u32 = 0u;

@vertex
fn vertex(solid: SolidVertex, @builtin(instance_index) part: u32) -> @builtin(position) vec4<f32> {
    return frame.shadows[MAP] * vec4(object_point(solid, part).world, 1.0);
}
