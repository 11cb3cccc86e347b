// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/quigley.wgsl
//!
//! Sway of one joint at a time in closed form: `J θ'' + (C + β K) θ' + K θ = T`, exact for a constant torque, whatever the step
//! and the stiffness.
//!
//! The joint's modes are found first: with `J = L Lᵀ` the eigenvalues λ and eigenvectors of `L⁻¹ K L⁻ᵀ` take the equation
//! apart into three single oscillators. Statics are exact; dynamics leave out that joints move each other, so
//! that a trunk of many segments sways too fast (`oracle::schemes` in the tests measures by how much).
//!
//! # Source
//! Quigley et al., "Real-time interactive tree animation" (2018), pass 2.

use super::composite::Composite;
use super::{Body, Constants, Joint};
use crate::arith::math::{exponential, inverse_sqrt, reciprocal, sin_cos};
use crate::arith::matrix::{Mat3, Sym3, mat3_times, mat3_transposed_times, sym3_axial, sym3_times};
use crate::arith::quaternion::{quat_rotate, quat_rotate_back, turn_of_quat};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::context::Context;

crate::shared_constants! {
    /// Sweeps of Jacobi rotations: more than a float needs for any matrix of three rows.
    pub const JACOBI_SWEEPS: u32 = 5;
    /// Largest discriminant, relative to the squared damping or stiffness, that counts as critical damping.
    pub const CRITICAL_SHARE: f32 = 1e-5;
    /// Softest spring, as the squared frequency in 1/s² of a sway of 200 s: softer ones would lose all digits.
    pub const SOFTEST: f32 = 1e-3;
    /// Largest damping exponent of one step: `e` to the minus this is nothing to a float.
    pub const DAMPED_MOST: f32 = 40.0;
    /// Largest phase of one step in rad: faster sway has long been damped out.
    pub const PHASE_MOST: f32 = 800.0;
}

/// Modes of a joint: three mode shapes as columns, and their squared angular frequencies.
#[derive(Clone, Copy, Debug)]
pub struct Modes {
    /// Shapes, scaled so that their inertia is one.
    pub shapes: Mat3,
    /// Squared angular frequencies in 1/s².
    pub stiffness: Vec3,
}

/// Displacement and rate of an oscillator.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// Displacement from rest.
    pub place: f32,
    /// Rate.
    pub rate: f32,
}

/// Rotation vector and rate of a joint after a step, in its segment's frame.
#[derive(Clone, Copy, Debug)]
pub struct Moved {
    /// Rotation in rad.
    pub turn: Vec3,
    /// Rate in rad/s.
    pub rate: Vec3,
}

/// Lower triangle of the Cholesky factor, inverted: `[1/l11, 1/l22, 1/l33]` on the diagonal, m21, m31, m32 below.
#[inline(always)]
fn inverse_factor(a: Sym3) -> (Vec3, Vec3) {
    let floor = TINY_SQUARED;
    let i1 = inverse_sqrt(a.diagonal.x.max(floor));
    let l21 = a.off.z * i1;
    let l31 = a.off.y * i1;
    let i2 = inverse_sqrt((a.diagonal.y - l21 * l21).max(a.diagonal.y * 1e-6).max(floor));
    let l32 = (a.off.x - l31 * l21) * i2;
    let rest = (a.diagonal.z - l31 * l31) - l32 * l32;
    let i3 = inverse_sqrt(rest.max(a.diagonal.z * 1e-6).max(floor));
    let m21 = -(l21 * i1) * i2;
    let m32 = -(l32 * i2) * i3;
    let m31 = -((l31 * i1 + l32 * m21) * i3);
    (Vec3::new(i1, i2, i3), Vec3::new(m21, m31, m32))
}

/// Sine and cosine of the rotation that frees a symmetric matrix of the entry `off` between diagonal `p` and `q`.
#[inline(always)]
fn jacobi_turn(p: f32, q: f32, off: f32) -> (f32, f32) {
    let span = q - p;
    let twice = off + off;
    let square = span * span + twice * twice;
    if square < TINY_SQUARED || (off < 1e-12 && off > -1e-12) {
        return (0.0, 1.0);
    }
    let length = square * inverse_sqrt(square);
    let reach = if span < 0.0 { -span } else { span };
    let tangent = twice * reciprocal(reach + length);
    let signed = if span < 0.0 { -tangent } else { tangent };
    let cosine = inverse_sqrt(1.0 + signed * signed);
    (signed * cosine, cosine)
}

/// Two axes of a symmetric matrix: their diagonal entries, what each shares with the third axis, and their shapes.
#[derive(Clone, Copy)]
struct Axes {
    p: f32,
    q: f32,
    side_p: f32,
    side_q: f32,
    shape_p: Vec3,
    shape_q: Vec3,
}

/// The axes turned into each other so that the entry `off` between them vanishes.
#[inline(always)]
fn jacobi_free(axes: Axes, off: f32) -> Axes {
    let (sine, cosine) = jacobi_turn(axes.p, axes.q, off);
    let p = axes.p * cosine - off * sine;
    let q = off * cosine - axes.q * sine;
    let p2 = axes.p * sine + off * cosine;
    let q2 = off * sine + axes.q * cosine;
    Axes {
        p: p * cosine - q * sine,
        q: p2 * sine + q2 * cosine,
        side_p: axes.side_p * cosine - axes.side_q * sine,
        side_q: axes.side_p * sine + axes.side_q * cosine,
        shape_p: axes.shape_p * cosine - axes.shape_q * sine,
        shape_q: axes.shape_p * sine + axes.shape_q * cosine,
    }
}

/// Modes of inertia `inertia` on springs `springs`.
#[inline(always)]
pub fn joint_modes(inertia: Sym3, springs: Sym3) -> Modes {
    let (d, m) = inverse_factor(inertia);
    // Rows of the inverse factor.
    let r1 = Vec3::new(d.x, 0.0, 0.0);
    let r2 = Vec3::new(m.x, d.y, 0.0);
    let r3 = Vec3::new(m.y, m.z, d.z);
    let k1 = sym3_times(springs, r1);
    let k2 = sym3_times(springs, r2);
    let k3 = sym3_times(springs, r3);
    let mut xx = vec3_dot(r1, k1);
    let mut yy = vec3_dot(r2, k2);
    let mut zz = vec3_dot(r3, k3);
    let mut yz = vec3_dot(r2, k3);
    let mut xz = vec3_dot(r1, k3);
    let mut xy = vec3_dot(r1, k2);
    // Columns of the shapes: the transposed inverse factor, turned along.
    let mut a = Vec3::new(d.x, 0.0, 0.0);
    let mut b = Vec3::new(m.x, d.y, 0.0);
    let mut c = Vec3::new(m.y, m.z, d.z);
    for _ in 0..JACOBI_SWEEPS {
        let z = jacobi_free(Axes { p: xx, q: yy, side_p: xz, side_q: yz, shape_p: a, shape_q: b }, xy);
        let y = jacobi_free(
            Axes { p: z.p, q: zz, side_p: 0.0, side_q: z.side_q, shape_p: z.shape_p, shape_q: c },
            z.side_p,
        );
        let x = jacobi_free(
            Axes { p: z.q, q: y.q, side_p: y.side_p, side_q: 0.0, shape_p: z.shape_q, shape_q: y.shape_q },
            y.side_q,
        );
        (xx, yy, zz) = (y.p, x.p, x.q);
        (xy, xz, yz) = (x.side_p, x.side_q, 0.0);
        (a, b, c) = (y.shape_p, x.shape_p, x.shape_q);
    }
    let shapes =
        Mat3 { x: Vec3::new(a.x, b.x, c.x), y: Vec3::new(a.y, b.y, c.y), z: Vec3::new(a.z, b.z, c.z) };
    Modes { shapes, stiffness: Vec3::new(xx, yy, zz) }
}

/// An oscillator of squared frequency `stiffness` and damping `2 a` after `dt` seconds under a force that holds still.
#[inline(always)]
pub fn swing_step(swing: Swing, stiffness: f32, a: f32, force: f32, dt: f32) -> Swing {
    let spring = stiffness.max(SOFTEST);
    let target = force * reciprocal(spring);
    let x = swing.place - target;
    let discriminant = a * a - spring;
    let small = CRITICAL_SHARE * (a * a + spring);
    let mut cosine = exponential(-(a * dt).min(DAMPED_MOST));
    let mut sine = dt * cosine;
    if discriminant < -small {
        let frequency = -discriminant;
        let inverse = inverse_sqrt(frequency);
        let (s, c) = sin_cos(((frequency * inverse) * dt).min(PHASE_MOST));
        sine = (cosine * s) * inverse;
        cosine *= c;
    } else if discriminant > small {
        let inverse = inverse_sqrt(discriminant);
        let root = discriminant * inverse;
        // a - root without cancellation: their product is the stiffness.
        let slow = spring * reciprocal(a + root);
        let late = exponential(-(slow * dt).min(DAMPED_MOST));
        let early = exponential(-((a + root) * dt).min(DAMPED_MOST));
        cosine = (late + early) * 0.5;
        sine = (late - early) * (0.5 * inverse);
    }
    Swing {
        place: target + ((cosine + a * sine) * x + sine * swing.rate),
        rate: (cosine - a * sine) * swing.rate - (spring * sine) * x,
    }
}

/// Steps a joint that carries `whole`.
#[inline(always)]
pub fn quigley_step(
    cx: &Context<'_>,
    constants: &Constants,
    joint: &Joint,
    body: &Body,
    axis: Vec3,
    whole: &Composite,
) -> Moved {
    let dt = cx.scene.sway.dt_s;
    let springs = sym3_axial(axis, constants.twisting, constants.bending);
    let modes = joint_modes(whole.inertia, springs);
    let turn = quat_rotate(body.pose, turn_of_quat(joint.turn));
    let rate = quat_rotate(body.pose, joint.rate);
    let torque = whole.torque + quat_rotate(body.pose, constants.preload);
    let place = mat3_transposed_times(modes.shapes, sym3_times(whole.inertia, turn));
    let swing = mat3_transposed_times(modes.shapes, sym3_times(whole.inertia, rate));
    let force = mat3_transposed_times(modes.shapes, torque);
    // Drag damps a mode by as much as its shape moves.
    let x = Vec3::new(modes.shapes.x.x, modes.shapes.y.x, modes.shapes.z.x);
    let y = Vec3::new(modes.shapes.x.y, modes.shapes.y.y, modes.shapes.z.y);
    let z = Vec3::new(modes.shapes.x.z, modes.shapes.y.z, modes.shapes.z.z);
    let (beta, drag) = (constants.damping, whole.drag_inertia);
    let ax = 0.5 * (beta * modes.stiffness.x + drag * vec3_dot(x, x));
    let ay = 0.5 * (beta * modes.stiffness.y + drag * vec3_dot(y, y));
    let az = 0.5 * (beta * modes.stiffness.z + drag * vec3_dot(z, z));
    let sx = swing_step(Swing { place: place.x, rate: swing.x }, modes.stiffness.x, ax, force.x, dt);
    let sy = swing_step(Swing { place: place.y, rate: swing.y }, modes.stiffness.y, ay, force.y, dt);
    let sz = swing_step(Swing { place: place.z, rate: swing.z }, modes.stiffness.z, az, force.z, dt);
    let moved = mat3_times(modes.shapes, Vec3::new(sx.place, sy.place, sz.place));
    let moving = mat3_times(modes.shapes, Vec3::new(sx.rate, sy.rate, sz.rate));
    Moved { turn: quat_rotate_back(body.pose, moved), rate: quat_rotate_back(body.pose, moving) }
}
