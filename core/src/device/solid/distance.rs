// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/distance.wgsl
//!
//! Distance to a solid part of any shape.

use super::grid::grid_distance;
use super::hull::hull_distance;
use super::shape::{SOLID_GRID, SOLID_HULL, SolidAt, SolidDistance, core_distance};
use crate::arith::quaternion::{quat_rotate, quat_rotate_back};
use crate::arith::vector::Vec3;
use crate::context::Context;

/// Distance of a place from a part.
#[inline(always)]
pub fn solid_distance(cx: &Context<'_>, solid: &SolidAt, place: Vec3) -> SolidDistance {
    let inner = quat_rotate_back(solid.turn, place - solid.center);
    let mut found = if (solid.flags & SOLID_HULL) != 0 {
        hull_distance(cx, solid, inner)
    } else if (solid.flags & SOLID_GRID) != 0 {
        grid_distance(cx, solid, inner)
    } else {
        core_distance(solid, inner)
    };
    found.normal = quat_rotate(solid.turn, found.normal);
    found
}
