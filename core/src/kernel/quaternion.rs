// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernel/quaternion.wgsl
//!
//! Unit quaternions as rotations; `vec4<f32>` in WGSL, vector part first.

use super::lane::{Mask, Real};
use super::math::inverse_sqrt;
use super::vector::{TINY_SQUARED, Vec3, vec3_cross};

/// A quaternion x i + y j + z k + w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quat<R = f32> {
    /// Coefficient of i.
    pub x: R,
    /// Coefficient of j.
    pub y: R,
    /// Coefficient of k.
    pub z: R,
    /// Real part.
    pub w: R,
}

impl Quat {
    /// No rotation.
    pub const IDENTITY: Self = Self::new(0.0, 0.0, 0.0, 1.0);
}

impl<R> Quat<R> {
    /// A quaternion from its coefficients.
    #[inline(always)]
    pub const fn new(x: R, y: R, z: R, w: R) -> Self {
        Self { x, y, z, w }
    }
}

impl<R: Copy> Quat<R> {
    /// Coefficients in order.
    #[inline(always)]
    pub const fn to_array(self) -> [R; 4] {
        [self.x, self.y, self.z, self.w]
    }
}

impl<R> From<[R; 4]> for Quat<R> {
    #[inline(always)]
    fn from([x, y, z, w]: [R; 4]) -> Self {
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

/// Rotation `q` followed by a turn about y, given by sine and cosine of half its angle.
#[inline(always)]
pub fn quat_turn_after<R: Real>(q: Quat<R>, half_sine: R, half_cosine: R) -> Quat<R> {
    Quat::new(
        half_cosine * q.x + half_sine * q.z,
        half_cosine * q.y + half_sine * q.w,
        half_cosine * q.z - half_sine * q.x,
        half_cosine * q.w - half_sine * q.y,
    )
}

/// A turn about y, given by sine and cosine of half its angle, followed by rotation `q`.
#[inline(always)]
pub fn quat_turn_before<R: Real>(q: Quat<R>, half_sine: R, half_cosine: R) -> Quat<R> {
    Quat::new(
        half_cosine * q.x - half_sine * q.z,
        half_cosine * q.y + half_sine * q.w,
        half_cosine * q.z + half_sine * q.x,
        half_cosine * q.w - half_sine * q.y,
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
pub fn quat_norm_squared<R: Real>(q: Quat<R>) -> R {
    (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w)
}

/// One Newton step towards unit norm, for quaternions already near it.
#[inline(always)]
pub fn quat_renormalize<R: Real>(q: Quat<R>) -> Quat<R> {
    let k = q.w.all(1.5) - quat_norm_squared(q) * 0.5;
    Quat::new(q.x * k, q.y * k, q.z * k, q.w * k)
}

/// Unit quaternion of the same direction, for any norm from 1e-9 up.
#[inline(always)]
pub fn quat_normalize<R: Real>(q: Quat<R>) -> Quat<R> {
    let k = inverse_sqrt(quat_norm_squared(q).max(q.w.all(TINY_SQUARED)));
    Quat::new(q.x * k, q.y * k, q.z * k, q.w * k)
}

/// The rotation a share `weight` of the way from `start` to `end`, along the shorter arc (normalised linear blend).
#[inline(always)]
pub fn quat_blend<R: Real>(start: Quat<R>, end: Quat<R>, weight: R) -> Quat<R> {
    let cosine = (start.x * end.x + start.y * end.y) + (start.z * end.z + start.w * end.w);
    let signed_weight = cosine.less_than(weight.all(0.0)).select_real(-weight, weight);
    let rest = weight.all(1.0) - weight;
    quat_normalize(Quat::new(
        start.x * rest + end.x * signed_weight,
        start.y * rest + end.y * signed_weight,
        start.z * rest + end.z * signed_weight,
        start.w * rest + end.w * signed_weight,
    ))
}
