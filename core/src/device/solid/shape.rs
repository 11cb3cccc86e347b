// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/shape.wgsl
//!
//! Solid parts, and the distance to those without faces: a box or a cylinder, rounded by a radius. A ball is a rounded cylinder of no
//! size, a capsule one of no radius.

use crate::arith::math::inverse_sqrt;
use crate::arith::quaternion::Quat;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::context::Context;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Rows of a part: flags, and sizes or where its faces are; rounding, bound, friction and restitution; centre; turn.
    pub const SOLID_ROWS: u32 = 4;
    /// Flag of a part that is a cylinder, not a box.
    pub const SOLID_ROUND: u32 = 1;
    /// Flag of a part whose friction is a share of the speed along it, not a coefficient of Coulomb's law.
    pub const SOLID_LOSS: u32 = 2;
    /// Flag of a part that is a convex polyhedron.
    pub const SOLID_HULL: u32 = 4;
    /// Flag of a part whose distances are on a grid.
    pub const SOLID_GRID: u32 = 8;
}

/// A solid part at a moment.
#[derive(Clone, Copy, Debug)]
pub struct SolidAt {
    /// [`SOLID_ROUND`], [`SOLID_LOSS`], [`SOLID_HULL`], [`SOLID_GRID`].
    pub flags: u32,
    /// First row of the faces of a polyhedron, or of a grid.
    pub first_row: u32,
    /// Number of the faces of a polyhedron.
    pub face_count: u32,
    /// Half edges of its core in m; of a cylinder, radius, half of the height, and nothing; zero of what has faces.
    pub half_m: Vec3,
    /// Radius in m by which it is rounded.
    pub rounding_m: f32,
    /// Distance in m from its centre to its farthest point.
    pub bound_m: f32,
    /// Friction, as its flags say.
    pub friction: f32,
    /// Coefficient of restitution.
    pub restitution: f32,
    /// Centre in m.
    pub center: Vec3,
    /// Orientation.
    pub turn: Quat,
    /// Velocity in m/s.
    pub velocity: Vec3,
    /// Angular velocity in rad/s.
    pub spin: Vec3,
}

/// Distance of a place from a part.
#[derive(Clone, Copy, Debug)]
pub struct SolidDistance {
    /// Distance in m from its surface, below zero inside.
    pub distance_m: f32,
    /// Unit vector away from it.
    pub normal: Vec3,
}

/// Three floats of a row.
#[inline(always)]
pub fn row_vector(row: Uint4) -> Vec3 {
    let Uint4([x, y, z, _]) = row;
    Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z))
}

/// A part so many seconds into the step.
#[inline(always)]
pub fn solid_at(cx: &Context<'_>, number: u32, seconds: f32) -> SolidAt {
    let first = (cx.scene.solids.first_row + number * SOLID_ROWS) as usize;
    let rows = [cx.tables[first], cx.tables[first + 1], cx.tables[first + 2], cx.tables[first + 3]];
    solid_of_rows(cx, number, rows, seconds)
}

/// The same by its rows of the tables.
#[inline(always)]
pub fn solid_of_rows(cx: &Context<'_>, number: u32, rows: [Uint4; 4], seconds: f32) -> SolidAt {
    let [sizes, surface, center, turn] = rows;
    let Uint4([flags, half_x, half_y, half_z]) = sizes;
    let Uint4([rounding, bound, friction, restitution]) = surface;
    let Uint4(turn) = turn;
    let mut half_m = Vec3::ZERO;
    if (flags & (SOLID_HULL | SOLID_GRID)) == 0 {
        half_m = Vec3::new(f32::from_bits(half_x), f32::from_bits(half_y), f32::from_bits(half_z));
    }
    let mut solid = SolidAt {
        flags,
        first_row: half_x,
        face_count: half_y,
        half_m,
        rounding_m: f32::from_bits(rounding),
        bound_m: f32::from_bits(bound),
        friction: f32::from_bits(friction),
        restitution: f32::from_bits(restitution),
        center: row_vector(center),
        turn: Quat::from(turn.map(f32::from_bits)),
        velocity: Vec3::ZERO,
        spin: Vec3::ZERO,
    };
    if number < cx.scene.solids.mover_count {
        let mover = &cx.step.movers[number as usize];
        solid.turn = Quat::from(mover.turn);
        solid.velocity = Vec3::from(mover.velocity_m_s);
        solid.spin = Vec3::from(mover.spin_rad_s);
        solid.center = Vec3::from(mover.center_m) + solid.velocity * seconds;
    }
    solid
}

/// A number with the sign of another.
#[inline(always)]
fn with_sign(number: f32, of: f32) -> f32 {
    if of < 0.0 { -number } else { number }
}

/// Distance of a place in the frame of a part without faces, and the normal there. Inside its core the normal is that of the nearest side.
#[inline(always)]
pub fn core_distance(solid: &SolidAt, inner: Vec3) -> SolidDistance {
    let radial_squared = (inner.x * inner.x + inner.z * inner.z).max(TINY_SQUARED);
    let inv_radial = inverse_sqrt(radial_squared);
    let is_round = (solid.flags & SOLID_ROUND) != 0;
    let signs = Vec3::new(with_sign(1.0, inner.x), with_sign(1.0, inner.y), with_sign(1.0, inner.z));
    let beyond_x = if is_round { radial_squared * inv_radial } else { inner.x * signs.x } - solid.half_m.x;
    let beyond_y = inner.y * signs.y - solid.half_m.y;
    let beyond_z = if is_round { -1.0 } else { inner.z * signs.z - solid.half_m.z };
    let outside = Vec3::new(beyond_x.max(0.0), beyond_y.max(0.0), beyond_z.max(0.0));
    let squared = vec3_dot(outside, outside);
    // Along the three directions of the shape's own: of a cylinder, radial, axial and none.
    let mut along = Vec3::new(1.0, 0.0, 0.0);
    let mut distance = beyond_x;
    if TINY_SQUARED < squared {
        let inverse = inverse_sqrt(squared);
        along = outside * inverse;
        distance = squared * inverse;
    } else if !is_round && beyond_x < beyond_z && beyond_y < beyond_z {
        along = Vec3::new(0.0, 0.0, 1.0);
        distance = beyond_z;
    } else if beyond_x < beyond_y {
        along = Vec3::new(0.0, 1.0, 0.0);
        distance = beyond_y;
    }
    let mut normal = Vec3::new(along.x * signs.x, along.y * signs.y, along.z * signs.z);
    if is_round {
        normal =
            Vec3::new(along.x * (inner.x * inv_radial), along.y * signs.y, along.x * (inner.z * inv_radial));
    }
    SolidDistance { distance_m: distance - solid.rounding_m, normal }
}

/// Velocity of a part at a place in m/s.
#[inline(always)]
pub fn solid_velocity(solid: &SolidAt, place: Vec3) -> Vec3 {
    let arm = place - solid.center;
    solid.velocity + vec3_cross(solid.spin, arm)
}
