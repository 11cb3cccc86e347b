// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/arith/matrix.wgsl
//!
//! Matrices of three rows, symmetric and general, for the inertia of bodies.

use super::lane::{Real, each_number};
use super::math::reciprocal;
use super::vector::{Vec3, vec3_cross, vec3_dot};

crate::shared_constants! {
    /// Smallest pivot of [`sym3_inverse`], relative to the diagonal: rounding must not turn a positive matrix around.
    pub const PIVOT_SHARE: f32 = 1e-6;
}

/// A symmetric matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sym3<R = f32> {
    /// Diagonal xx, yy, zz.
    pub diagonal: Vec3<R>,
    /// Off the diagonal: yz, xz, xy.
    pub off: Vec3<R>,
}

/// A general matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3<R = f32> {
    /// First row.
    pub x: Vec3<R>,
    /// Second row.
    pub y: Vec3<R>,
    /// Third row.
    pub z: Vec3<R>,
}

each_number!(Mat3 { ; x, y, z });

/// Sum.
#[inline(always)]
pub fn sym3_add<R: Real>(a: Sym3<R>, b: Sym3<R>) -> Sym3<R> {
    Sym3 { diagonal: a.diagonal + b.diagonal, off: a.off + b.off }
}

/// Difference.
#[inline(always)]
pub fn sym3_minus<R: Real>(a: Sym3<R>, b: Sym3<R>) -> Sym3<R> {
    Sym3 { diagonal: a.diagonal - b.diagonal, off: a.off - b.off }
}

/// `across` times the identity plus `along - across` times the projection on the unit vector `axis`.
#[inline(always)]
pub fn sym3_axial<R: Real>(axis: Vec3<R>, along: R, across: R) -> Sym3<R> {
    let more = along - across;
    let x = axis.x * more;
    let y = axis.y * more;
    let z = axis.z * more;
    Sym3 {
        diagonal: Vec3::new(across + x * axis.x, across + y * axis.y, across + z * axis.z),
        off: Vec3::new(y * axis.z, x * axis.z, x * axis.y),
    }
}

/// The product of [`sym3_axial`] with a vector.
#[inline(always)]
pub fn axial_times<R: Real>(axis: Vec3<R>, along: R, across: R, v: Vec3<R>) -> Vec3<R> {
    v * across + axis * ((along - across) * vec3_dot(axis, v))
}

/// The matrix's product with a vector.
#[inline(always)]
pub fn sym3_times<R: Real>(a: Sym3<R>, v: Vec3<R>) -> Vec3<R> {
    Vec3::new(
        (a.diagonal.x * v.x + a.off.z * v.y) + a.off.y * v.z,
        (a.off.z * v.x + a.diagonal.y * v.y) + a.off.x * v.z,
        (a.off.y * v.x + a.off.x * v.y) + a.diagonal.z * v.z,
    )
}

/// Sum of the diagonal.
#[inline(always)]
pub fn sym3_trace<R: Real>(a: Sym3<R>) -> R {
    (a.diagonal.x + a.diagonal.y) + a.diagonal.z
}

/// The symmetric matrix as a general one.
#[inline(always)]
pub fn sym3_rows<R: Real>(a: Sym3<R>) -> Mat3<R> {
    Mat3 {
        x: Vec3::new(a.diagonal.x, a.off.z, a.off.y),
        y: Vec3::new(a.off.z, a.diagonal.y, a.off.x),
        z: Vec3::new(a.off.y, a.off.x, a.diagonal.z),
    }
}

/// Inverse of a positive definite matrix, by its factors L D Lᵀ.
#[inline(always)]
pub fn sym3_inverse<R: Real>(a: Sym3<R>) -> Sym3<R> {
    let i1 = reciprocal(a.diagonal.x);
    let l21 = a.off.z * i1;
    let l31 = a.off.y * i1;
    let d2 = (a.diagonal.y - l21 * a.off.z).max(a.diagonal.y * PIVOT_SHARE);
    let i2 = reciprocal(d2);
    let t = a.off.x - l31 * a.off.z;
    let l32 = t * i2;
    let d3 = ((a.diagonal.z - l31 * a.off.y) - l32 * t).max(a.diagonal.z * PIVOT_SHARE);
    let i3 = reciprocal(d3);
    let m31 = l32 * l21 - l31;
    Sym3 {
        diagonal: Vec3::new((i1 + (l21 * l21) * i2) + (m31 * m31) * i3, i2 + (l32 * l32) * i3, i3),
        off: Vec3::new(-(l32 * i3), m31 * i3, -(l21 * i2) - (m31 * l32) * i3),
    }
}

/// Sum.
#[inline(always)]
pub fn mat3_add<R: Real>(a: Mat3<R>, b: Mat3<R>) -> Mat3<R> {
    Mat3 { x: a.x + b.x, y: a.y + b.y, z: a.z + b.z }
}

/// The matrix of the vector product `v x`, times `scale`.
#[inline(always)]
pub fn mat3_cross<R: Real>(v: Vec3<R>, scale: R) -> Mat3<R> {
    let s = v * scale;
    let zero = scale.all(0.0);
    Mat3 { x: Vec3::new(zero, -s.z, s.y), y: Vec3::new(s.z, zero, -s.x), z: Vec3::new(-s.y, s.x, zero) }
}

/// The matrix's product with a vector.
#[inline(always)]
pub fn mat3_times<R: Real>(a: Mat3<R>, v: Vec3<R>) -> Vec3<R> {
    Vec3::new(vec3_dot(a.x, v), vec3_dot(a.y, v), vec3_dot(a.z, v))
}

/// The transposed matrix's product with a vector.
#[inline(always)]
pub fn mat3_transposed_times<R: Real>(a: Mat3<R>, v: Vec3<R>) -> Vec3<R> {
    (a.x * v.x + a.y * v.y) + a.z * v.z
}

/// A row vector's product with a matrix.
#[inline(always)]
fn row_times<R: Real>(row: Vec3<R>, b: Mat3<R>) -> Vec3<R> {
    (b.x * row.x + b.y * row.y) + b.z * row.z
}

/// The product of two matrices.
#[inline(always)]
pub fn mat3_product<R: Real>(a: Mat3<R>, b: Mat3<R>) -> Mat3<R> {
    Mat3 { x: row_times(a.x, b), y: row_times(a.y, b), z: row_times(a.z, b) }
}

/// The upper half of a product that is symmetric.
#[inline(always)]
pub fn mat3_product_symmetric<R: Real>(a: Mat3<R>, b: Mat3<R>) -> Sym3<R> {
    mat3_upper(mat3_product(a, b))
}

/// The upper half of `aᵀ b`, if that is symmetric.
#[inline(always)]
pub fn mat3_transposed_product_symmetric<R: Real>(a: Mat3<R>, b: Mat3<R>) -> Sym3<R> {
    let ax = Vec3::new(a.x.x, a.y.x, a.z.x);
    let ay = Vec3::new(a.x.y, a.y.y, a.z.y);
    let az = Vec3::new(a.x.z, a.y.z, a.z.z);
    let bx = Vec3::new(b.x.x, b.y.x, b.z.x);
    let by = Vec3::new(b.x.y, b.y.y, b.z.y);
    let bz = Vec3::new(b.x.z, b.y.z, b.z.z);
    Sym3 {
        diagonal: Vec3::new(vec3_dot(ax, bx), vec3_dot(ay, by), vec3_dot(az, bz)),
        off: Vec3::new(vec3_dot(ay, bz), vec3_dot(ax, bz), vec3_dot(ax, by)),
    }
}

/// `[r x] a` for a matrix of columns that are turned: every column's vector product with `r` from the left.
#[inline(always)]
pub fn mat3_cross_from_left<R: Real>(r: Vec3<R>, a: Mat3<R>) -> Mat3<R> {
    Mat3 { x: a.z * r.y - a.y * r.z, y: a.x * r.z - a.z * r.x, z: a.y * r.x - a.x * r.y }
}

/// `a [r x]ᵀ`: every row's vector product with `r`, `r x row`.
#[inline(always)]
pub fn mat3_cross_from_right<R: Real>(a: Mat3<R>, r: Vec3<R>) -> Mat3<R> {
    Mat3 { x: vec3_cross(r, a.x), y: vec3_cross(r, a.y), z: vec3_cross(r, a.z) }
}

/// The upper half of a matrix that is symmetric.
#[inline(always)]
pub fn mat3_upper<R: Real>(a: Mat3<R>) -> Sym3<R> {
    Sym3 { diagonal: Vec3::new(a.x.x, a.y.y, a.z.z), off: Vec3::new(a.y.z, a.x.z, a.x.y) }
}

/// The matrix plus its transpose.
#[inline(always)]
pub fn mat3_twice_symmetric<R: Real>(a: Mat3<R>) -> Sym3<R> {
    Sym3 {
        diagonal: Vec3::new(a.x.x + a.x.x, a.y.y + a.y.y, a.z.z + a.z.z),
        off: Vec3::new(a.y.z + a.z.y, a.x.z + a.z.x, a.x.y + a.y.x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vec3> {
        [-3f32..3.0, -3f32..3.0, -3f32..3.0].prop_map(Vec3::from)
    }

    fn matrix() -> impl Strategy<Value = Mat3> {
        [vector(), vector(), vector()].prop_map(|[x, y, z]| Mat3 { x, y, z })
    }

    fn near(a: Vec3, b: Vec3, scale: f32) -> bool {
        let d = a - b;
        d.x.abs().max(d.y.abs()).max(d.z.abs()) <= 2e-5 * scale
    }

    proptest! {
        #[test]
        fn an_inverse_undoes_its_matrix(a in matrix(), v in vector()) {
            let square = mat3_transposed_product_symmetric(a, a);
            let sturdy = sym3_add(square, sym3_axial(Vec3::new(0.0, 1.0, 0.0), 0.5, 0.5));
            let back = sym3_times(sturdy, sym3_times(sym3_inverse(sturdy), v));
            prop_assert!(near(back, v, 60.0), "{back:?} for {v:?}");
        }

        #[test]
        fn products_agree_with_applying_one_after_the_other(a in matrix(), b in matrix(), v in vector(), r in vector()) {
            let both = mat3_times(mat3_product(a, b), v);
            prop_assert!(near(both, mat3_times(a, mat3_times(b, v)), 60.0), "product");
            let left = mat3_times(mat3_cross_from_left(r, a), v);
            prop_assert!(near(left, vec3_cross(r, mat3_times(a, v)), 60.0), "from the left");
            let right = mat3_times(mat3_cross_from_right(a, r), v);
            prop_assert!(near(right, mat3_times(a, vec3_cross(v, r)), 60.0), "from the right");
            let cross = mat3_times(mat3_cross(r, 2.0), v);
            prop_assert!(near(cross, vec3_cross(r, v) * 2.0, 60.0), "vector product");
            let transposed = mat3_transposed_times(a, v);
            prop_assert!((vec3_dot(transposed, r) - vec3_dot(v, mat3_times(a, r))).abs() < 1e-3, "transposed");
            let symmetric = sym3_times(mat3_twice_symmetric(a), v);
            prop_assert!(near(symmetric, mat3_times(a, v) + transposed, 60.0), "sum with the transposed");
            let square = sym3_times(mat3_transposed_product_symmetric(a, a), v);
            prop_assert!(near(square, mat3_transposed_times(a, mat3_times(a, v)), 60.0), "square");
            let rows = mat3_times(sym3_rows(mat3_twice_symmetric(a)), v);
            prop_assert!(near(rows, symmetric, 60.0), "rows");
        }

        #[test]
        fn an_axial_matrix_stretches_along_its_axis(v in vector(), w in vector()) {
            let axis = w * (1.0 / vec3_dot(w, w).sqrt().max(1e-3));
            prop_assume!((vec3_dot(axis, axis) - 1.0).abs() < 1e-5);
            let along = axis * vec3_dot(axis, v);
            let expected = along * 5.0 + (v - along) * 0.5;
            prop_assert!(near(sym3_times(sym3_axial(axis, 5.0, 0.5), v), expected, 10.0), "{expected:?}");
            prop_assert!(near(axial_times(axis, 5.0, 0.5, v), expected, 10.0), "{expected:?} at once");
        }
    }
}
