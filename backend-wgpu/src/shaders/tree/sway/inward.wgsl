// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/inward.rs
#import bindings
#import arith/math
#import arith/matrix
#import arith/quaternion
#import arith/vector
#import tree/sway/body

struct JointReduction {
    response: JointResponse,
    apparent: ArticulatedInertia,
}

fn velocity_products(body: Body, parent: Body) -> VelocityProducts {
    let arm = body.base - parent.base;
    return VelocityProducts(
        arm,
        vec3_cross(parent.spin, body.spin - parent.spin),
        vec3_cross(parent.spin, vec3_cross(parent.spin, arm)),
    );
}

fn articulated_add(a: ArticulatedInertia, b: ArticulatedInertia) -> ArticulatedInertia {
    return ArticulatedInertia(
        sym3_add(a.rotation, b.rotation),
        mat3_add(a.coupling, b.coupling),
        sym3_add(a.mass, b.mass),
        a.moment + b.moment,
        a.force + b.force,
    );
}

fn joint_spring(constants: SegmentConstants, joint: Joint, body: Body, carried: f32) -> Spring {
    let bending = constants.bending;
    let ahead = scene.sway.ahead_s;
    let damping = constants.damping + ahead;
    let turn = turn_of_quat(joint.turn);
    let spring = turn + joint.rate * damping;
    var torque = vec3<f32>(
        constants.preload.x - bending * spring.x,
        constants.preload.y - constants.twisting * spring.y,
        constants.preload.z - bending * spring.z,
    );
    let implicit = ahead * damping;
    var along = constants.twisting * implicit;
    var across = bending * implicit;
    let squared = vec3_dot(turn, turn);
    if (STOP_ANGLE * STOP_ANGLE < squared) {
        let stiffness = carried * STOP_STIFFNESS;
        let share = 1.0 - inverse_sqrt(max(squared, TINY_SQUARED)) * STOP_ANGLE;
        let stop = turn * share + joint.rate * (ahead + STOP_DAMPING);
        torque = torque - stop * stiffness;
        let stopped = stiffness * (ahead * (ahead + STOP_DAMPING));
        along = along + stopped;
        across = across + stopped;
    }
    return Spring(quat_rotate(body.pose, torque), along, across);
}

fn joint_response(joint: Spring, whole: ArticulatedInertia, axis: vec3<f32>, products: VelocityProducts) -> JointReduction {
    let torque = joint.torque;
    let spring = sym3_axial(axis, joint.along, joint.across);
    let inverse = sym3_inverse(sym3_add(whole.rotation, spring));
    let share = mat3_product(sym3_rows(spring), sym3_rows(inverse));
    let pull = torque - whole.moment;
    let lever = mat3_product(sym3_rows(inverse), whole.coupling);

    let rotation = mat3_product_symmetric(share, sym3_rows(whole.rotation));
    let coupling = mat3_product(share, whole.coupling);
    let mass = sym3_minus(whole.mass, mat3_transposed_product_symmetric(whole.coupling, lever));

    let moment = (torque - mat3_times(share, pull))
        + (sym3_times(rotation, products.angular) + mat3_times(coupling, products.centripetal));
    let force = (whole.force + mat3_transposed_times(lever, pull))
        + (mat3_transposed_times(coupling, products.angular) + sym3_times(mass, products.centripetal));
    return JointReduction(
        JointResponse(sym3_times(inverse, pull), share, lever, products),
        ArticulatedInertia(rotation, coupling, mass, moment, force),
    );
}

fn articulated_shift(body: ArticulatedInertia, arm: vec3<f32>) -> ArticulatedInertia {
    let carried = mat3_cross_from_left(arm, sym3_rows(body.mass));
    let turned = mat3_twice_symmetric(mat3_cross_from_right(body.coupling, arm));
    let swung = mat3_upper(mat3_cross_from_right(carried, arm));
    return ArticulatedInertia(
        sym3_add(body.rotation, sym3_add(turned, swung)),
        mat3_add(body.coupling, carried),
        body.mass,
        body.moment + vec3_cross(arm, body.force),
        body.force,
    );
}
