// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/arith/vector.wgsl
//!
//! Three-component vectors whose every operation is spelled out.

use core::ops::{Add, Mul, Sub};

use super::lane::{Mask, Real, each_number};
use super::math::inverse_sqrt;

/// A vector of three floats; `vec3<f32>` in WGSL.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<R = f32> {
    /// Along x.
    pub x: R,
    /// Along y, up.
    pub y: R,
    /// Along z.
    pub z: R,
}

crate::shared_constants! {
    /// Smallest squared length that still counts; keeps the Newton steps of [`inverse_sqrt`] in range.
    pub const TINY_SQUARED: f32 = 1e-18;
}

impl Vec3 {
    /// The zero vector.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// Components in order.
    #[inline(always)]
    pub const fn to_array(self) -> [f32; 3] {
        [self.x, self.y, self.z]
    }

    /// The same vector for all lanes of a number.
    #[inline(always)]
    pub fn spread<R: Real>(self, like: R) -> Vec3<R> {
        Vec3::new(like.all(self.x), like.all(self.y), like.all(self.z))
    }
}

each_number!(Vec3 { x, y, z });

impl<R> Vec3<R> {
    /// A vector from its components.
    #[inline(always)]
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }
}

impl From<[f32; 3]> for Vec3 {
    #[inline(always)]
    fn from([x, y, z]: [f32; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: R) -> Self {
        Self::new(self.x * b, self.y * b, self.z * b)
    }
}

/// Scalar product.
#[inline(always)]
pub fn vec3_dot<R: Real>(a: Vec3<R>, b: Vec3<R>) -> R {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Vector product.
#[inline(always)]
pub fn vec3_cross<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// `yes` where true, `no` elsewhere.
#[inline(always)]
pub fn vec3_select<R: Real>(mask: R::Mask, yes: Vec3<R>, no: Vec3<R>) -> Vec3<R> {
    Vec3::new(mask.select_real(yes.x, no.x), mask.select_real(yes.y, no.y), mask.select_real(yes.z, no.z))
}

/// Linear blend `a + t (b - a)`.
#[inline(always)]
pub fn vec3_lerp<R: Real>(a: Vec3<R>, b: Vec3<R>, t: R) -> Vec3<R> {
    Vec3::new(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z))
}

/// Length; lengths below 1e-9 come out as if they were a little longer than they are.
#[inline(always)]
pub fn vec3_length(a: Vec3) -> f32 {
    let squared = vec3_dot(a, a);
    squared * inverse_sqrt(squared.max(TINY_SQUARED))
}
