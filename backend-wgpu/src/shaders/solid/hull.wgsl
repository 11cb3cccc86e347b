// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/hull.rs
// Distance to a convex polyhedron.
#import bindings
#import arith/vector
#import solid/shape

fn hull_distance(solid: SolidAt, inner: vec3<f32>) -> SolidDistance {
    var farthest = SolidDistance(-solid.bound_m, vec3<f32>(0.0, 1.0, 0.0));
    for (var face = 0u; face < solid.face_count; face += 1u) {
        let row = bitcast<vec4<f32>>(tables[solid.first_row + face]);
        let distance = vec3_dot(row.xyz, inner) - row.w;
        if (farthest.distance_m < distance) {
            farthest = SolidDistance(distance, row.xyz);
        }
    }
    return farthest;
}
