// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/arith/matrix.rs
// Matrices of three by three, symmetric and not.
#import arith/math
#import arith/vector

struct Sym3 {
    // xx, yy, zz.
    diagonal: vec3<f32>,
    // yz, xz, xy.
    off: vec3<f32>,
}

// Rows.
struct Mat3 {
    x: vec3<f32>,
    y: vec3<f32>,
    z: vec3<f32>,
}

fn sym3_add(a: Sym3, b: Sym3) -> Sym3 {
    return Sym3(a.diagonal + b.diagonal, a.off + b.off);
}

fn sym3_minus(a: Sym3, b: Sym3) -> Sym3 {
    return Sym3(a.diagonal - b.diagonal, a.off - b.off);
}

fn sym3_axial(axis: vec3<f32>, along: f32, across: f32) -> Sym3 {
    let more = along - across;
    let x = axis.x * more;
    let y = axis.y * more;
    let z = axis.z * more;
    return Sym3(
        vec3<f32>(across + x * axis.x, across + y * axis.y, across + z * axis.z),
        vec3<f32>(y * axis.z, x * axis.z, x * axis.y),
    );
}

fn axial_times(axis: vec3<f32>, along: f32, across: f32, v: vec3<f32>) -> vec3<f32> {
    return v * across + axis * ((along - across) * vec3_dot(axis, v));
}

fn sym3_times(a: Sym3, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        (a.diagonal.x * v.x + a.off.z * v.y) + a.off.y * v.z,
        (a.off.z * v.x + a.diagonal.y * v.y) + a.off.x * v.z,
        (a.off.y * v.x + a.off.x * v.y) + a.diagonal.z * v.z,
    );
}

fn sym3_trace(a: Sym3) -> f32 {
    return (a.diagonal.x + a.diagonal.y) + a.diagonal.z;
}

fn sym3_rows(a: Sym3) -> Mat3 {
    return Mat3(
        vec3<f32>(a.diagonal.x, a.off.z, a.off.y),
        vec3<f32>(a.off.z, a.diagonal.y, a.off.x),
        vec3<f32>(a.off.y, a.off.x, a.diagonal.z),
    );
}

fn sym3_inverse(a: Sym3) -> Sym3 {
    let i1 = reciprocal(a.diagonal.x);
    let l21 = a.off.z * i1;
    let l31 = a.off.y * i1;
    let d2 = max(a.diagonal.y - l21 * a.off.z, a.diagonal.y * PIVOT_SHARE);
    let i2 = reciprocal(d2);
    let t = a.off.x - l31 * a.off.z;
    let l32 = t * i2;
    let d3 = max((a.diagonal.z - l31 * a.off.y) - l32 * t, a.diagonal.z * PIVOT_SHARE);
    let i3 = reciprocal(d3);
    let m31 = l32 * l21 - l31;
    return Sym3(
        vec3<f32>((i1 + (l21 * l21) * i2) + (m31 * m31) * i3, i2 + (l32 * l32) * i3, i3),
        vec3<f32>(-(l32 * i3), m31 * i3, -(l21 * i2) - (m31 * l32) * i3),
    );
}

fn mat3_add(a: Mat3, b: Mat3) -> Mat3 {
    return Mat3(a.x + b.x, a.y + b.y, a.z + b.z);
}

fn mat3_cross(v: vec3<f32>, scale: f32) -> Mat3 {
    let s = v * scale;
    return Mat3(vec3<f32>(0.0, -s.z, s.y), vec3<f32>(s.z, 0.0, -s.x), vec3<f32>(-s.y, s.x, 0.0));
}

fn mat3_times(a: Mat3, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(vec3_dot(a.x, v), vec3_dot(a.y, v), vec3_dot(a.z, v));
}

fn mat3_transposed_times(a: Mat3, v: vec3<f32>) -> vec3<f32> {
    return (a.x * v.x + a.y * v.y) + a.z * v.z;
}

fn row_times(row: vec3<f32>, b: Mat3) -> vec3<f32> {
    return (b.x * row.x + b.y * row.y) + b.z * row.z;
}

fn mat3_product(a: Mat3, b: Mat3) -> Mat3 {
    return Mat3(row_times(a.x, b), row_times(a.y, b), row_times(a.z, b));
}

fn mat3_product_symmetric(a: Mat3, b: Mat3) -> Sym3 {
    return mat3_upper(mat3_product(a, b));
}

fn mat3_transposed_product_symmetric(a: Mat3, b: Mat3) -> Sym3 {
    let ax = vec3<f32>(a.x.x, a.y.x, a.z.x);
    let ay = vec3<f32>(a.x.y, a.y.y, a.z.y);
    let az = vec3<f32>(a.x.z, a.y.z, a.z.z);
    let bx = vec3<f32>(b.x.x, b.y.x, b.z.x);
    let by = vec3<f32>(b.x.y, b.y.y, b.z.y);
    let bz = vec3<f32>(b.x.z, b.y.z, b.z.z);
    return Sym3(
        vec3<f32>(vec3_dot(ax, bx), vec3_dot(ay, by), vec3_dot(az, bz)),
        vec3<f32>(vec3_dot(ay, bz), vec3_dot(ax, bz), vec3_dot(ax, by)),
    );
}

fn mat3_cross_from_left(r: vec3<f32>, a: Mat3) -> Mat3 {
    return Mat3(a.z * r.y - a.y * r.z, a.x * r.z - a.z * r.x, a.y * r.x - a.x * r.y);
}

fn mat3_cross_from_right(a: Mat3, r: vec3<f32>) -> Mat3 {
    return Mat3(vec3_cross(r, a.x), vec3_cross(r, a.y), vec3_cross(r, a.z));
}

fn mat3_upper(a: Mat3) -> Sym3 {
    return Sym3(vec3<f32>(a.x.x, a.y.y, a.z.z), vec3<f32>(a.y.z, a.x.z, a.x.y));
}

fn mat3_twice_symmetric(a: Mat3) -> Sym3 {
    return Sym3(
        vec3<f32>(a.x.x + a.x.x, a.y.y + a.y.y, a.z.z + a.z.z),
        vec3<f32>(a.y.z + a.z.y, a.x.z + a.z.x, a.x.y + a.y.x),
    );
}
