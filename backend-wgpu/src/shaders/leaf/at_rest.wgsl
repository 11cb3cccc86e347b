// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/at_rest.rs
// The wind that moves a leaf at rest: it slides, tips over its lee edge, or lifts.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import flight/contact
#import flight/rates
#import terrain/ground

struct LeafAtRest {
    body: LeafBody,
    pose: vec4<f32>,
    normal: vec3<f32>,
    friction: f32,
    raise: u32,
    pressing_m_s2: f32,
}

fn leaf_at_rest(body: LeafBody, pose: vec4<f32>, slope: Slope, friction: f32, raise: u32) -> LeafAtRest {
    let up = inverse_sqrt(slope.gain);
    let normal = vec3<f32>(-(slope.x * up), up, -(slope.z * up));
    let suction = scene.litter.adhesion_m2_s2 * body.air_per_m;
    return LeafAtRest(body, pose, normal, friction, raise, scene.gravity_m_s2 + suction);
}

fn square_to_overcome(holding: f32, force: f32) -> f32 {
    if (force > LEAST_FORCE) {
        return max(holding, 0.0) * reciprocal(force);
    }
    return NEVER_WAKES;
}

fn raising_axis(leaf: LeafAtRest, direction: vec3<f32>) -> vec3<f32> {
    let axis = vec3_cross(leaf.normal, direction);
    return axis * inverse_sqrt(max(vec3_dot(axis, axis), TINY_SQUARED));
}

fn wake_square(leaf: LeafAtRest, direction: vec3<f32>) -> f32 {
    let axis = raising_axis(leaf, direction);
    let half = sin_cos_turns((leaf.raise << 16u) >> 1u);
    let pose = quat_multiply(vec4<f32>(axis.x * half.x, axis.y * half.x, axis.z * half.x, half.y), leaf.pose);
    let flow = quat_rotate_back(pose, direction * -1.0);
    let inner = still_load(leaf.body, flow);
    let force = quat_rotate(pose, inner.force);
    let torque = quat_rotate(pose, inner.torque);
    let lift = vec3_dot(force, leaf.normal);
    let level = force - leaf.normal * lift;
    let squared = max(vec3_dot(level, level), TINY_SQUARED);
    let inverse = inverse_sqrt(squared);
    let way = level * inverse;
    let drag = squared * inverse;
    let holding = leaf.pressing_m_s2 * leaf.normal.y;
    let radius = support(leaf.body, quat_rotate_back(pose, way)).radius;
    let lever = vec3_dot(torque, vec3_cross(leaf.normal, way)) * reciprocal(radius * leaf.body.inv_size_ratio);
    let downhill = scene.gravity_m_s2 * way.y;
    let lifts = square_to_overcome(holding, lift);
    let tips = square_to_overcome(holding, lift + lever);
    let slides = square_to_overcome(leaf.friction * holding + downhill, drag + leaf.friction * lift);
    return min(min(lifts, tips), slides);
}

fn least_wake_square(leaf: LeafAtRest) -> f32 {
    var least = NEVER_WAKES;
    for (var number = 0u; number < DROP_DIRECTIONS; number++) {
        let direction = drop_direction(number);
        least = min(wake_square(leaf, vec3<f32>(direction.x, 0.0, direction.y)), least);
    }
    return max(least, LEAST_WAKES);
}

fn wind_moves(leaf: LeafAtRest, wind: vec3<f32>, share_squared: f32) -> bool {
    let squared = max(vec3_dot(wind, wind), TINY_SQUARED);
    let direction = wind * inverse_sqrt(squared);
    return wake_square(leaf, direction) * share_squared < squared;
}

fn slides_down(leaf: LeafAtRest) -> bool {
    let up_squared = leaf.normal.y * leaf.normal.y;
    return (leaf.friction * leaf.friction) * up_squared < 1.0 - up_squared;
}
