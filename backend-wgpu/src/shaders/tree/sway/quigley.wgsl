// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/quigley.rs
#import arith/math
#import arith/matrix
#import arith/quaternion
#import arith/vector
#import tree/sway/composite

struct Modes {
    shapes: Mat3,
    stiffness: vec3<f32>,
}

struct Swing {
    place: f32,
    rate: f32,
}

// The diagonal of the inverse factor; m21, m31, m32 below it.
struct Factor {
    diagonal: vec3<f32>,
    below: vec3<f32>,
}

// Rotation vector and rate.
struct Moved {
    turn: vec3<f32>,
    rate: vec3<f32>,
}

fn inverse_factor(a: Sym3) -> Factor {
    let low = TINY_SQUARED;
    let i1 = inverse_sqrt(max(a.diagonal.x, low));
    let l21 = a.off.z * i1;
    let l31 = a.off.y * i1;
    let i2 = inverse_sqrt(max(max(a.diagonal.y - l21 * l21, a.diagonal.y * 1e-6), low));
    let l32 = (a.off.x - l31 * l21) * i2;
    let rest = (a.diagonal.z - l31 * l31) - l32 * l32;
    let i3 = inverse_sqrt(max(max(rest, a.diagonal.z * 1e-6), low));
    let m21 = -(l21 * i1) * i2;
    let m32 = -(l32 * i2) * i3;
    let m31 = -((l31 * i1 + l32 * m21) * i3);
    return Factor(vec3<f32>(i1, i2, i3), vec3<f32>(m21, m31, m32));
}

// Sine and cosine.
fn jacobi_turn(p: f32, q: f32, off: f32) -> vec2<f32> {
    let span = q - p;
    let twice = off + off;
    let square = span * span + twice * twice;
    if (square < TINY_SQUARED || (off < 1e-12 && off > -1e-12)) {
        return vec2<f32>(0.0, 1.0);
    }
    let length = square * inverse_sqrt(square);
    let reach = select(span, -span, span < 0.0);
    let tangent = twice * reciprocal(reach + length);
    let turned = select(tangent, -tangent, span < 0.0);
    let cosine = inverse_sqrt(1.0 + turned * turned);
    return vec2<f32>(turned * cosine, cosine);
}

struct Axes {
    p: f32,
    q: f32,
    side_p: f32,
    side_q: f32,
    shape_p: vec3<f32>,
    shape_q: vec3<f32>,
}

fn jacobi_free(axes: Axes, off: f32) -> Axes {
    let turn = jacobi_turn(axes.p, axes.q, off);
    let sine = turn.x;
    let cosine = turn.y;
    let p = axes.p * cosine - off * sine;
    let q = off * cosine - axes.q * sine;
    let p2 = axes.p * sine + off * cosine;
    let q2 = off * sine + axes.q * cosine;
    return Axes(
        p * cosine - q * sine,
        p2 * sine + q2 * cosine,
        axes.side_p * cosine - axes.side_q * sine,
        axes.side_p * sine + axes.side_q * cosine,
        axes.shape_p * cosine - axes.shape_q * sine,
        axes.shape_p * sine + axes.shape_q * cosine,
    );
}

fn joint_modes(inertia: Sym3, springs: Sym3) -> Modes {
    let factor = inverse_factor(inertia);
    let d = factor.diagonal;
    let m = factor.below;
    let r1 = vec3<f32>(d.x, 0.0, 0.0);
    let r2 = vec3<f32>(m.x, d.y, 0.0);
    let r3 = vec3<f32>(m.y, m.z, d.z);
    let k1 = sym3_times(springs, r1);
    let k2 = sym3_times(springs, r2);
    let k3 = sym3_times(springs, r3);
    var xx = vec3_dot(r1, k1);
    var yy = vec3_dot(r2, k2);
    var zz = vec3_dot(r3, k3);
    var yz = vec3_dot(r2, k3);
    var xz = vec3_dot(r1, k3);
    var xy = vec3_dot(r1, k2);
    var a = r1;
    var b = r2;
    var c = r3;
    for (var sweep = 0u; sweep < JACOBI_SWEEPS; sweep++) {
        let z = jacobi_free(Axes(xx, yy, xz, yz, a, b), xy);
        let y = jacobi_free(Axes(z.p, zz, 0.0, z.side_q, z.shape_p, c), z.side_p);
        let x = jacobi_free(Axes(z.q, y.q, y.side_p, 0.0, z.shape_q, y.shape_q), y.side_q);
        xx = y.p;
        yy = x.p;
        zz = x.q;
        xy = x.side_p;
        xz = x.side_q;
        yz = 0.0;
        a = y.shape_p;
        b = x.shape_p;
        c = x.shape_q;
    }
    return Modes(
        Mat3(vec3<f32>(a.x, b.x, c.x), vec3<f32>(a.y, b.y, c.y), vec3<f32>(a.z, b.z, c.z)),
        vec3<f32>(xx, yy, zz),
    );
}

fn swing_step(swing: Swing, stiffness: f32, a: f32, force: f32, dt: f32) -> Swing {
    let spring = max(stiffness, SOFTEST);
    let destination = force * reciprocal(spring);
    let x = swing.place - destination;
    let discriminant = a * a - spring;
    let small = CRITICAL_SHARE * (a * a + spring);
    var cosine = exponential(-min(a * dt, DAMPED_MOST));
    var sine = dt * cosine;
    if (discriminant < -small) {
        let frequency = -discriminant;
        let inverse = inverse_sqrt(frequency);
        let turn = sin_cos(min((frequency * inverse) * dt, PHASE_MOST));
        sine = (cosine * turn.x) * inverse;
        cosine = cosine * turn.y;
    } else if (discriminant > small) {
        let inverse = inverse_sqrt(discriminant);
        let root = discriminant * inverse;
        let slow = spring * reciprocal(a + root);
        let late = exponential(-min(slow * dt, DAMPED_MOST));
        let early = exponential(-min((a + root) * dt, DAMPED_MOST));
        cosine = (late + early) * 0.5;
        sine = (late - early) * (0.5 * inverse);
    }
    return Swing(
        destination + ((cosine + a * sine) * x + sine * swing.rate),
        (cosine - a * sine) * swing.rate - (spring * sine) * x,
    );
}

fn quigley_step(constants: SegmentConstants, joint: Joint, body: Body, axis: vec3<f32>, whole: Composite) -> Moved {
    let dt = scene.sway.dt_s;
    let springs = sym3_axial(axis, constants.twisting, constants.bending);
    let modes = joint_modes(whole.inertia, springs);
    let turn = quat_rotate(body.pose, turn_of_quat(joint.turn));
    let rate = quat_rotate(body.pose, joint.rate);
    let torque = whole.torque + quat_rotate(body.pose, constants.preload);
    let place = mat3_transposed_times(modes.shapes, sym3_times(whole.inertia, turn));
    let swing = mat3_transposed_times(modes.shapes, sym3_times(whole.inertia, rate));
    let force = mat3_transposed_times(modes.shapes, torque);
    let x = vec3<f32>(modes.shapes.x.x, modes.shapes.y.x, modes.shapes.z.x);
    let y = vec3<f32>(modes.shapes.x.y, modes.shapes.y.y, modes.shapes.z.y);
    let z = vec3<f32>(modes.shapes.x.z, modes.shapes.y.z, modes.shapes.z.z);
    let beta = constants.damping;
    let drag = whole.drag_inertia;
    let ax = 0.5 * (beta * modes.stiffness.x + drag * vec3_dot(x, x));
    let ay = 0.5 * (beta * modes.stiffness.y + drag * vec3_dot(y, y));
    let az = 0.5 * (beta * modes.stiffness.z + drag * vec3_dot(z, z));
    let sx = swing_step(Swing(place.x, swing.x), modes.stiffness.x, ax, force.x, dt);
    let sy = swing_step(Swing(place.y, swing.y), modes.stiffness.y, ay, force.y, dt);
    let sz = swing_step(Swing(place.z, swing.z), modes.stiffness.z, az, force.z, dt);
    let moved = mat3_times(modes.shapes, vec3<f32>(sx.place, sy.place, sz.place));
    let moving = mat3_times(modes.shapes, vec3<f32>(sx.rate, sy.rate, sz.rate));
    return Moved(quat_rotate_back(body.pose, moved), quat_rotate_back(body.pose, moving));
}
