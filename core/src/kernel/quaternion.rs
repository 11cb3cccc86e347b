// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernel/quaternion.wgsl
//!
//! Unit quaternions as rotations; `vec4<f32>` in WGSL, vector part first.

use super::math::inverse_sqrt;
use super::vector::{TINY_SQUARED, Vec3, vec3_cross};

/// A quaternion x i + y j + z k + w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quat {
    /// Coefficient of i.
    pub x: f32,
    /// Coefficient of j.
    pub y: f32,
    /// Coefficient of k.
    pub z: f32,
    /// Real part.
    pub w: f32,
}

impl Quat {
    /// No rotation.
    pub const IDENTITY: Self = Self::new(0.0, 0.0, 0.0, 1.0);

    /// A quaternion from its coefficients.
    #[inline(always)]
    pub const fn new(x: f32, y: f32, z: f32, w: f32) -> Self {
        Self { x, y, z, w }
    }

    /// Coefficients in order.
    #[inline(always)]
    pub const fn to_array(self) -> [f32; 4] {
        [self.x, self.y, self.z, self.w]
    }
}

impl From<[f32; 4]> for Quat {
    #[inline(always)]
    fn from([x, y, z, w]: [f32; 4]) -> Self {
        Self { x, y, z, w }
    }
}

/// Rotation `b` followed by rotation `a`.
#[inline(always)]
pub fn quat_multiply(a: Quat, b: Quat) -> Quat {
    Quat::new(
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
        a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    )
}

/// The vector `v` turned by `q`.
#[inline(always)]
pub fn quat_rotate(q: Quat, v: Vec3) -> Vec3 {
    let axis = Vec3::new(q.x, q.y, q.z);
    let twice = vec3_cross(axis, v) * 2.0;
    v + twice * q.w + vec3_cross(axis, twice)
}

/// Squared norm.
#[inline(always)]
pub fn quat_norm_squared(q: Quat) -> f32 {
    (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w)
}

/// One Newton step towards unit norm, for quaternions already near it.
#[inline(always)]
pub fn quat_renormalize(q: Quat) -> Quat {
    let k = 1.5 - 0.5 * quat_norm_squared(q);
    Quat::new(q.x * k, q.y * k, q.z * k, q.w * k)
}

/// Unit quaternion of the same direction, for any norm from 1e-9 up.
#[inline(always)]
pub fn quat_normalize(q: Quat) -> Quat {
    let k = inverse_sqrt(quat_norm_squared(q).max(TINY_SQUARED));
    Quat::new(q.x * k, q.y * k, q.z * k, q.w * k)
}

/// The rotation a share `weight` of the way from `start` to `end`, along the shorter arc (normalised linear blend).
#[inline(always)]
pub fn quat_blend(start: Quat, end: Quat, weight: f32) -> Quat {
    let cosine = (start.x * end.x + start.y * end.y) + (start.z * end.z + start.w * end.w);
    let signed_weight = if cosine < 0.0 { -weight } else { weight };
    let rest = 1.0 - weight;
    quat_normalize(Quat::new(
        start.x * rest + end.x * signed_weight,
        start.y * rest + end.y * signed_weight,
        start.z * rest + end.z * signed_weight,
        start.w * rest + end.w * signed_weight,
    ))
}
