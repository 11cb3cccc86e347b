// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/oliapuram_kumar.rs
#import arith/math
#import arith/quaternion
#import tree/sway/composite
#import tree/sway/quigley

fn rod_step(turn: f32, rate: f32, torque: f32, stiffness: f32, inertia: f32, damping: f32, dt: f32) -> Swing {
    let held = inertia + dt * (damping + dt * stiffness);
    let next = (inertia * rate + dt * (torque - stiffness * turn)) * reciprocal(held);
    return Swing(turn + dt * next, next);
}

fn oliapuram_kumar_step(constants: SegmentConstants, joint: Joint, body: Body, whole: Composite) -> Moved {
    let dt = scene.sway.dt_s;
    let inertia = 0.5 * ((whole.inertia.diagonal.x + whole.inertia.diagonal.y) + whole.inertia.diagonal.z);
    let torque = quat_rotate_back(body.pose, whole.torque) + constants.preload;
    let turn = turn_of_quat(joint.turn);
    let bend = constants.damping * constants.bending + whole.drag_inertia;
    let twist = constants.damping * constants.twisting + whole.drag_inertia;
    let x = rod_step(turn.x, joint.rate.x, torque.x, constants.bending, inertia, bend, dt);
    let y = rod_step(turn.y, joint.rate.y, torque.y, constants.twisting, inertia, twist, dt);
    let z = rod_step(turn.z, joint.rate.z, torque.z, constants.bending, inertia, bend, dt);
    return Moved(vec3<f32>(x.place, y.place, z.place), vec3<f32>(x.rate, y.rate, z.rate));
}
