// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/flight/rates.rs
#import flight/body
#import kernel/math
#import kernel/vector

struct FlightMotion {
    velocity: vec3<f32>,
    pose: vec4<f32>,
    turning: vec3<f32>,
}

fn flight_rates(body: LeafBody, motion: FlightMotion, wind: vec3<f32>) -> FlightMotion {
    let x = motion.pose.x;
    let y = motion.pose.y;
    let z = motion.pose.z;
    let w = motion.pose.w;
    let x2 = x + x;
    let y2 = y + y;
    let z2 = z + z;
    let xx = x * x2;
    let yy = y * y2;
    let zz = z * z2;
    let xy = x * y2;
    let xz = x * z2;
    let yz = y * z2;
    let wx = w * x2;
    let wy = w * y2;
    let wz = w * z2;
    let across = vec3<f32>(1.0 - (yy + zz), xy + wz, xz - wy);
    let normal = vec3<f32>(xy - wz, 1.0 - (xx + zz), yz + wx);
    let along = vec3<f32>(xz + wy, yz - wx, 1.0 - (xx + yy));

    let relative = motion.velocity - wind;
    let u = vec3<f32>(vec3_dot(across, relative), vec3_dot(normal, relative), vec3_dot(along, relative));
    let turn = motion.turning;
    let flow = u + vec3_cross(turn, body.arm);
    let squared = max(vec3_dot(flow, flow), TINY_SQUARED);
    let slowness = inverse_sqrt(squared);
    let speed = squared * slowness;
    let across2 = flow.x * flow.x;
    let along2 = flow.z * flow.z;
    let tangent = across2 + along2;
    let incidence = flow.y * slowness;
    let q = incidence * incidence;

    let air = body.air;
    let resist = (air.x * 0.5) * ((q * (DRAG_RISE - q * DRAG_BEND) + body.own.y) * speed);
    let slope = q + (body.slope.x * across2 + body.slope.y * along2) * (slowness * slowness);
    let raise = (air.x * slope) * ((q * (q * LIFT_BEND + LIFT_RISE) + LIFT_EDGE) * incidence);
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl = vec3_cross(
        vec3<f32>((air.z * circulation) * turn.x, 0.0, (air.w * circulation) * turn.z),
        flow,
    );
    let force = vec3<f32>(
        whirl.x + (raise * flow.y - resist) * flow.x,
        whirl.y - (raise * tangent + resist * flow.y),
        whirl.z + (raise * flow.y - resist) * flow.z,
    );

    let drawn = air.y * flow.y;
    let push = vec3<f32>(force.x + drawn * turn.z, force.y, force.z - drawn * turn.x);
    let munk = drawn * (q * MUNK_RISE + MUNK_EDGE);
    let edge_x = body.reach.x * turn.x;
    let edge_z = body.reach.y * turn.z;
    let edge = max(edge_x * edge_x + edge_z * edge_z, TINY_SQUARED);
    let damping = (edge * inverse_sqrt(edge)) * DAMPING_TURN;
    let roll = (slowness * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (slowness * (q * body.own.x)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * body.reach.z;
    let wheeling = (speed + max(wheel, 0.0 - wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.arm, push);
    let torque = vec3<f32>(
        (lever.x + munk * flow.z) - air.z * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + body.reach.w * (speed * flow.y)) - (air.z * body.reach.y) * (wheeling * turn.y),
        (lever.z - munk * flow.x) - air.w * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
    );
    let freely = vec3<f32>(
        torque.x * body.ease.x + body.gyration.x * (turn.y * turn.z),
        torque.y * body.ease.y + body.gyration.y * (turn.z * turn.x),
        torque.z * body.ease.z + body.gyration.z * (turn.x * turn.y),
    );

    let size = body.size.y;
    let carried = (turn.z * u.x - turn.x * u.z) * size;
    let swung = body.arm.x * freely.z - body.arm.z * freely.x;
    let gathered = ((push.y - FLIGHT_GRAVITY * normal.y) - carried) + swung;
    let resistance = body.resistance * gathered;
    let inner = vec3<f32>(
        push.x - FLIGHT_GRAVITY * across.y,
        (push.y - FLIGHT_GRAVITY * normal.y) - resistance,
        push.z - FLIGHT_GRAVITY * along.y,
    );
    let acceleration = across * inner.x + normal * inner.y + along * inner.z;
    let turning = vec3<f32>(
        freely.x + (resistance * body.arm.z) * body.ease.x,
        freely.y,
        freely.z - (resistance * body.arm.x) * body.ease.z,
    );

    let half = turn * (size * 0.5);
    let pose = vec4<f32>(
        w * half.x + (y * half.z - z * half.y),
        w * half.y + (z * half.x - x * half.z),
        w * half.z + (x * half.y - y * half.x),
        0.0 - (x * half.x + y * half.y + z * half.z),
    );
    return FlightMotion(acceleration, pose, turning);
}
