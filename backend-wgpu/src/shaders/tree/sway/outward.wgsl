// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/outward.rs
#import bindings
#import arith/math
#import arith/matrix
#import arith/quaternion
#import arith/vector
#import tree/sway/body

struct Acceleration {
    angular: vec3<f32>,
    linear: vec3<f32>,
}

struct JointAcceleration {
    acceleration: Acceleration,
    // The joint's own part of the angular acceleration.
    own: vec3<f32>,
}

fn carried_acceleration(products: VelocityProducts, parent: Acceleration) -> Acceleration {
    return Acceleration(
        parent.angular + products.angular,
        (parent.linear + vec3_cross(parent.angular, products.arm)) + products.centripetal,
    );
}

fn joint_acceleration(response: JointResponse, parent: Acceleration) -> JointAcceleration {
    let carried = carried_acceleration(response.products, parent);
    let own = ((response.free - carried.angular) + mat3_transposed_times(response.spring, carried.angular))
        - mat3_times(response.lever, carried.linear);
    return JointAcceleration(Acceleration(carried.angular + own, carried.linear), own);
}

fn shortened(v: vec3<f32>, limit: f32) -> vec3<f32> {
    let squared = vec3_dot(v, v);
    if (limit * limit < squared) {
        return v * (limit * inverse_sqrt(max(squared, TINY_SQUARED)));
    }
    return v;
}

fn joint_step(joint: Joint, body: Body, own: vec3<f32>) -> Joint {
    let dt = scene.sway.dt_s;
    let limit = TURN_LIMIT * scene.sway.inv_dt_s;
    let gain = quat_rotate_back(body.pose, own) * dt;
    let rate = shortened(joint.rate + gain, limit);
    let on_the_way = shortened(joint.rate + gain * IMPLICITNESS, limit);
    let moved = quat_multiply(joint.turn, quat_of_turn(on_the_way * dt));
    return joint_stop(quat_renormalize(moved), rate);
}

fn joint_stop(turn: vec4<f32>, rate: vec3<f32>) -> Joint {
    let axis = vec3<f32>(turn.x, turn.y, turn.z);
    let squared = vec3_dot(axis, axis);
    if (JOINT_LIMIT * JOINT_LIMIT < squared) {
        let inverse = inverse_sqrt(max(squared, TINY_SQUARED));
        let outward = max(vec3_dot(rate, axis) * (inverse * inverse), 0.0);
        return Joint(vec4<f32>(axis * (inverse * JOINT_LIMIT), JOINT_LIMIT_COSINE), rate - axis * outward);
    }
    return Joint(turn, rate);
}

fn joint_held(turn: vec3<f32>, rate: vec3<f32>) -> Joint {
    let squared = vec3_dot(turn, turn);
    let stopped = squared > TURN_LIMIT * TURN_LIMIT;
    let outward = max(vec3_dot(rate, turn) * reciprocal(max(squared, TINY_SQUARED)), 0.0);
    let kept = rate - turn * select(0.0, outward, stopped);
    return Joint(
        quat_renormalize(quat_of_turn(shortened(turn, TURN_LIMIT))),
        shortened(kept, TURN_LIMIT * scene.sway.inv_dt_s),
    );
}

fn segment_place(constants: SegmentConstants, joint: Joint, parent: Body) -> Body {
    let pose = quat_multiply(quat_multiply(parent.pose, constants.rest), joint.turn);
    let arm = quat_rotate(parent.pose, constants.offset);
    return Body(
        parent.base + arm,
        pose,
        parent.velocity + vec3_cross(parent.spin, arm),
        parent.spin + quat_rotate(pose, joint.rate),
    );
}
