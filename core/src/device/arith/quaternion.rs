// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/arith/quaternion.wgsl
//!
//! Unit quaternions as rotations; `vec4<f32>` in WGSL, vector part first.

use super::lane::{Mask, Real, each_number};
use super::math::inverse_sqrt;
use super::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};

crate::shared_constants! {
    /// Series of sin(a/2)/a in a^2 up to one radian, second term.
    pub const TURN_SIN_3: f32 = -2.083_333_2e-2;
    /// Third term.
    pub const TURN_SIN_5: f32 = 2.604_099_6e-4;
    /// Fourth term.
    pub const TURN_SIN_7: f32 = -1.539_369e-6;
    /// Series of cos(a/2) in a^2 up to one radian, second term.
    pub const TURN_COS_2: f32 = -0.124_999_98;
    /// Third term.
    pub const TURN_COS_4: f32 = 2.604_046_1e-3;
    /// Fourth term.
    pub const TURN_COS_6: f32 = -2.150_838_2e-5;
    /// Series of 2 asin(s)/s in s^2 up to s = 0.5, second term.
    pub const TURN_ASIN_3: f32 = 0.333_333_46;
    /// Third term.
    pub const TURN_ASIN_5: f32 = 0.149_976_15;
    /// Fourth term.
    pub const TURN_ASIN_7: f32 = 9.002_245e-2;
    /// Fifth term.
    pub const TURN_ASIN_9: f32 = 5.298_051e-2;
    /// Sixth term.
    pub const TURN_ASIN_11: f32 = 7.643_153e-2;
}

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

each_number!(Quat { x, y, z, w });

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
pub fn quat_multiply<R: Real>(a: Quat<R>, b: Quat<R>) -> Quat<R> {
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
pub fn quat_rotate<R: Real>(q: Quat<R>, v: Vec3<R>) -> Vec3<R> {
    let axis = Vec3::new(q.x, q.y, q.z);
    let cross = vec3_cross(axis, v);
    let twice = cross + cross;
    v + twice * q.w + vec3_cross(axis, twice)
}

/// The vector `v` turned back by `q`.
#[inline(always)]
pub fn quat_rotate_back<R: Real>(q: Quat<R>, v: Vec3<R>) -> Vec3<R> {
    let axis = Vec3::new(q.x, q.y, q.z);
    let cross = vec3_cross(v, axis);
    let twice = cross + cross;
    v + twice * q.w + vec3_cross(twice, axis)
}

/// The y axis turned by `q`.
#[inline(always)]
pub fn quat_axis_y<R: Real>(q: Quat<R>) -> Vec3<R> {
    let x = q.x * q.y - q.z * q.w;
    let y = q.x * q.x + q.z * q.z;
    let z = q.y * q.z + q.x * q.w;
    Vec3::new(x + x, y.all(1.0) - (y + y), z + z)
}

/// The rotation by a vector of at most one radian.
#[inline(always)]
pub fn quat_of_turn<R: Real>(turn: Vec3<R>) -> Quat<R> {
    let t = vec3_dot(turn, turn);
    let sine = t * (t * (t * TURN_SIN_7 + TURN_SIN_5) + TURN_SIN_3) + 0.5;
    let cosine = t * (t * (t * TURN_COS_6 + TURN_COS_4) + TURN_COS_2) + 1.0;
    Quat::new(turn.x * sine, turn.y * sine, turn.z * sine, cosine)
}

/// The vector of a rotation by at most a sixth of a turn, its scalar part positive.
#[inline(always)]
pub fn turn_of_quat<R: Real>(q: Quat<R>) -> Vec3<R> {
    let s = (q.x * q.x + q.y * q.y) + q.z * q.z;
    let series =
        s * (s * (s * (s * (s * TURN_ASIN_11 + TURN_ASIN_9) + TURN_ASIN_7) + TURN_ASIN_5) + TURN_ASIN_3);
    let scale = series + 2.0;
    Vec3::new(q.x * scale, q.y * scale, q.z * scale)
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(most: f32) -> impl Strategy<Value = Vec3> {
        [-most..most, -most..most, -most..most].prop_map(Vec3::from)
    }

    fn unit() -> impl Strategy<Value = Quat> {
        let component = || -1f32..1.0;
        [component(), component(), component(), component()]
            .prop_map(Quat::from)
            .prop_filter("long enough", |q| quat_norm_squared(*q) > 0.01)
            .prop_map(quat_normalize)
    }

    fn distance(a: Vec3, b: Vec3) -> f32 {
        let d = a - b;
        d.x.abs().max(d.y.abs()).max(d.z.abs())
    }

    proptest! {
        /// Up to one radian, the largest turn of a joint in a step and nearly the largest that it ever has.
        #[test]
        fn a_turn_comes_back_from_its_quaternion(direction in vector(1.0), angle in 0f32..1.0) {
            let squared = vec3_dot(direction, direction);
            prop_assume!(squared > 0.01);
            let turn = direction * (angle * inverse_sqrt(squared));
            let q = quat_of_turn(turn);
            prop_assert!((quat_norm_squared(q) - 1.0).abs() < 1e-6, "{q:?} is of unit length");
            let back = turn_of_quat(q);
            prop_assert!(distance(back, turn) < 1e-6, "{back:?} for {turn:?}");
        }

        /// Against sine and cosine in double precision.
        #[test]
        fn a_turn_is_by_its_length(x in -0.57f32..0.57, y in -0.57f32..0.57, z in -0.57f32..0.57) {
            let wide = [f64::from(x), f64::from(y), f64::from(z)];
            let angle = libm::sqrt(wide.iter().map(|x| x * x).sum());
            let scale = if angle > 0.0 { libm::sin(0.5 * angle) / angle } else { 0.5 };
            let q = quat_of_turn(Vec3::new(x, y, z)).to_array().map(f64::from);
            for (part, component) in q.iter().zip(wide.map(|x| x * scale)) {
                prop_assert!((part - component).abs() < 2e-7, "{part} for {component}");
            }
            prop_assert!((q[3] - libm::cos(0.5 * angle)).abs() < 2e-7, "{} for {angle}", q[3]);
        }

        #[test]
        fn the_y_axis_turns_like_any_vector(q in unit()) {
            let expected = quat_rotate(q, Vec3::new(0.0, 1.0, 0.0));
            prop_assert!(distance(quat_axis_y(q), expected) < 1e-6, "{:?} for {expected:?}", quat_axis_y(q));
        }

        #[test]
        fn turning_back_undoes_turning(q in unit(), v in vector(10.0)) {
            let back = quat_rotate_back(q, quat_rotate(q, v));
            prop_assert!(distance(back, v) < 2e-5, "{back:?} for {v:?}");
            let conjugate = Quat::new(-q.x, -q.y, -q.z, q.w);
            let turned = quat_rotate(conjugate, v);
            prop_assert!(distance(quat_rotate_back(q, v), turned) < 1e-5, "like the conjugate: {turned:?}");
        }
    }
}
