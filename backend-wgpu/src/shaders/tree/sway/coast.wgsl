// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/coast.rs
#import bindings
#import arith/quaternion
#import tree/sway/body
#import tree/sway/outward

fn segment_coast(body: Body) -> Body {
    let dt = scene.dt_s;
    let turn = shortened(body.spin * dt, TURN_LIMIT);
    return Body(
        body.base + body.velocity * dt,
        quat_renormalize(quat_multiply(quat_of_turn(turn), body.pose)),
        body.velocity,
        body.spin,
    );
}
