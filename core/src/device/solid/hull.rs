// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/hull.wgsl
//!
//! Distance to a convex polyhedron: that from the farthest of the planes of its faces. Beyond an edge or a corner the nearest point is
//! farther, by less than the plane is from what touches it first.

use super::shape::{SolidAt, SolidDistance, row_vector};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::context::Context;
use crate::layout::Uint4;

/// Distance of a place in the frame of a polyhedron from its farthest plane, and the normal of that.
#[inline(always)]
pub fn hull_distance(cx: &Context<'_>, solid: &SolidAt, inner: Vec3) -> SolidDistance {
    let mut farthest = SolidDistance { distance_m: -solid.bound_m, normal: Vec3::new(0.0, 1.0, 0.0) };
    for face in 0..solid.face_count {
        let row = cx.tables[(solid.first_row + face) as usize];
        let normal = row_vector(row);
        let Uint4([_, _, _, offset]) = row;
        let distance = vec3_dot(normal, inner) - f32::from_bits(offset);
        if farthest.distance_m < distance {
            farthest = SolidDistance { distance_m: distance, normal };
        }
    }
    farthest
}
