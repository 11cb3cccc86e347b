// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/distance.rs
// Distance to a solid part of any shape.
#import arith/quaternion
#import solid/grid
#import solid/hull
#import solid/shape

fn solid_distance(solid: SolidAt, place: vec3<f32>) -> SolidDistance {
    let inner = quat_rotate_back(solid.turn, place - solid.center);
    var found: SolidDistance;
    if ((solid.flags & SOLID_HULL) != 0u) {
        found = hull_distance(solid, inner);
    } else if ((solid.flags & SOLID_GRID) != 0u) {
        found = grid_distance(solid, inner);
    } else {
        found = core_distance(solid, inner);
    }
    found.normal = quat_rotate(solid.turn, found.normal);
    return found;
}
