// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/arith/quaternion.rs
// Quaternions as vectors x, y, z, w.
#import arith/math
#import arith/vector

fn quat_multiply(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
        a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    );
}

fn quat_turn_after(q: vec4<f32>, half_sine: f32, half_cosine: f32) -> vec4<f32> {
    return vec4<f32>(
        half_cosine * q.x + half_sine * q.z,
        half_cosine * q.y + half_sine * q.w,
        half_cosine * q.z - half_sine * q.x,
        half_cosine * q.w - half_sine * q.y,
    );
}

fn quat_turn_before(q: vec4<f32>, half_sine: f32, half_cosine: f32) -> vec4<f32> {
    return vec4<f32>(
        half_cosine * q.x - half_sine * q.z,
        half_cosine * q.y + half_sine * q.w,
        half_cosine * q.z + half_sine * q.x,
        half_cosine * q.w - half_sine * q.y,
    );
}

fn quat_rotate(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    let axis = vec3<f32>(q.x, q.y, q.z);
    let cross = vec3_cross(axis, v);
    let twice = cross + cross;
    return v + twice * q.w + vec3_cross(axis, twice);
}

fn quat_rotate_back(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    let axis = vec3<f32>(q.x, q.y, q.z);
    let cross = vec3_cross(v, axis);
    let twice = cross + cross;
    return v + twice * q.w + vec3_cross(twice, axis);
}

fn quat_axis_y(q: vec4<f32>) -> vec3<f32> {
    let x = q.x * q.y - q.z * q.w;
    let y = q.x * q.x + q.z * q.z;
    let z = q.y * q.z + q.x * q.w;
    return vec3<f32>(x + x, 1.0 - (y + y), z + z);
}

fn quat_of_turn(turn: vec3<f32>) -> vec4<f32> {
    let t = vec3_dot(turn, turn);
    let sine = t * (t * (t * TURN_SIN_7 + TURN_SIN_5) + TURN_SIN_3) + 0.5;
    let cosine = t * (t * (t * TURN_COS_6 + TURN_COS_4) + TURN_COS_2) + 1.0;
    return vec4<f32>(turn.x * sine, turn.y * sine, turn.z * sine, cosine);
}

fn turn_of_quat(q: vec4<f32>) -> vec3<f32> {
    let s = (q.x * q.x + q.y * q.y) + q.z * q.z;
    let series = s * (s * (s * (s * (s * TURN_ASIN_11 + TURN_ASIN_9) + TURN_ASIN_7) + TURN_ASIN_5) + TURN_ASIN_3);
    let scale = series + 2.0;
    return vec3<f32>(q.x * scale, q.y * scale, q.z * scale);
}

fn quat_norm_squared(q: vec4<f32>) -> f32 {
    return (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
}

fn quat_renormalize(q: vec4<f32>) -> vec4<f32> {
    let k = 1.5 - 0.5 * quat_norm_squared(q);
    return vec4<f32>(q.x * k, q.y * k, q.z * k, q.w * k);
}

fn quat_normalize(q: vec4<f32>) -> vec4<f32> {
    let k = inverse_sqrt(max(quat_norm_squared(q), TINY_SQUARED));
    return vec4<f32>(q.x * k, q.y * k, q.z * k, q.w * k);
}

fn quat_blend(start: vec4<f32>, end: vec4<f32>, weight: f32) -> vec4<f32> {
    let cosine = (start.x * end.x + start.y * end.y) + (start.z * end.z + start.w * end.w);
    let signed_weight = select(weight, -weight, cosine < 0.0);
    let rest = 1.0 - weight;
    return quat_normalize(vec4<f32>(
        start.x * rest + end.x * signed_weight,
        start.y * rest + end.y * signed_weight,
        start.z * rest + end.z * signed_weight,
        start.w * rest + end.w * signed_weight,
    ));
}
