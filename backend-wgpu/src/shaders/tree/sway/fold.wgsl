// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/tree/sway/fold.rs
#import bindings
#import kernel/math
#import kernel/matrix
#import kernel/quaternion
#import kernel/vector
#import tree/sway/body

struct Spring {
    torque: vec3<f32>,
    inertia: Sym3,
}

struct Left {
    answer: Answer,
    body: Articulated,
}

fn articulated_add(a: Articulated, b: Articulated) -> Articulated {
    return Articulated(
        sym3_add(a.rotation, b.rotation),
        mat3_add(a.coupling, b.coupling),
        sym3_add(a.mass, b.mass),
        a.moment + b.moment,
        a.force + b.force,
    );
}

fn joint_spring(constants: Constants, joint: Joint, body: Body, axis: vec3<f32>, carried: Sym3) -> Spring {
    let bending = constants.bending;
    let ahead = environment.time.x * IMPLICITNESS;
    let turn = turn_of_quat(joint.turn);
    let spring = turn + joint.rate * (constants.damping + ahead);
    let squared = vec3_dot(turn, turn);
    let beyond = STOP_ANGLE * STOP_ANGLE < squared;
    let inertia = (carried.diagonal.x + carried.diagonal.y) + carried.diagonal.z;
    let stiffness = select(0.0, inertia * STOP_STIFFNESS, beyond);
    let share = 1.0 - inverse_sqrt(max(squared, TINY_SQUARED)) * STOP_ANGLE;
    let stop = turn * share + joint.rate * (ahead + STOP_DAMPING);
    let torque = vec3<f32>(
        (constants.preload.x - bending * spring.x) - stiffness * stop.x,
        (constants.preload.y - constants.twisting * spring.y) - stiffness * stop.y,
        (constants.preload.z - bending * spring.z) - stiffness * stop.z,
    );
    let stopped = stiffness * (ahead * (ahead + STOP_DAMPING));
    return Spring(
        quat_rotate(body.pose, torque),
        sym3_axial(axis, constants.twisting_inertia + stopped, constants.bending_inertia + stopped),
    );
}

fn joint_answer(torque: vec3<f32>, spring: Sym3, whole: Articulated, body: Body, parent: Body) -> Left {
    let inverse = sym3_inverse(sym3_add(whole.rotation, spring));
    let share = mat3_product(sym3_rows(spring), sym3_rows(inverse));
    let pull = torque - whole.moment;
    let lever = mat3_product(sym3_rows(inverse), whole.coupling);

    let rotation = mat3_product_symmetric(share, sym3_rows(whole.rotation));
    let coupling = mat3_product(share, whole.coupling);
    let mass = sym3_minus(whole.mass, mat3_transposed_product_symmetric(whole.coupling, lever));

    let arm = body.base - parent.base;
    let turning = vec3_cross(parent.spin, body.spin - parent.spin);
    let centripetal = vec3_cross(parent.spin, vec3_cross(parent.spin, arm));
    let moment = (torque - mat3_times(share, pull))
        + (sym3_times(rotation, turning) + mat3_times(coupling, centripetal));
    let force = (whole.force + mat3_transposed_times(lever, pull))
        + (mat3_transposed_times(coupling, turning) + sym3_times(mass, centripetal));
    return Left(
        Answer(sym3_times(inverse, pull), share, lever, arm, turning, centripetal),
        Articulated(rotation, coupling, mass, moment, force),
    );
}

fn articulated_shift(body: Articulated, arm: vec3<f32>) -> Articulated {
    let mass = sym3_rows(body.mass);
    let carried = mat3_cross_from_left(arm, mass);
    let turned = mat3_cross_from_right(body.coupling, arm);
    let swung = mat3_cross_from_right(carried, arm);
    let both = Mat3(turned.x + swung.x * 0.5, turned.y + swung.y * 0.5, turned.z + swung.z * 0.5);
    return Articulated(
        sym3_add(body.rotation, mat3_twice_symmetric(both)),
        mat3_add(body.coupling, carried),
        body.mass,
        body.moment + vec3_cross(arm, body.force),
        body.force,
    );
}
