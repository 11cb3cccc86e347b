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
    let steep = flow.y * slowness;
    let tangent = flow.x * flow.x + flow.z * flow.z;

    let resist = body.forces.x * speed + (body.forces.y * flow.y) * steep;
    let raise = body.forces.z * steep;
    let whirl = vec3_cross(vec3<f32>(body.turning.x * turn.x, 0.0, body.turning.y * turn.z), flow);
    let force = vec3<f32>(
        whirl.x + (raise * flow.y - resist) * flow.x,
        whirl.y - (raise * tangent + resist * flow.y),
        whirl.z + (raise * flow.y - resist) * flow.z,
    );

    let drawn = body.forces.w * flow.y;
    let push = vec3<f32>(force.x + drawn * turn.z, force.y, force.z - drawn * turn.x);
    let rate = max(turn.x * turn.x + turn.z * turn.z, TINY_SQUARED);
    let churn = rate * inverse_sqrt(rate);
    let lever = vec3_cross(body.arm, push);
    let gyration = body.gyration;
    let freely = vec3<f32>(
        ((lever.x + drawn * flow.z) - (body.turning.z * speed + body.damping.x * churn) * turn.x) * body.ease.x
            + gyration.x * (turn.y * turn.z),
        ((lever.y + body.damping.w * (speed * flow.y)) - (body.damping.z * speed) * turn.y) * body.ease.y
            + gyration.y * (turn.z * turn.x),
        ((lever.z - drawn * flow.x) - (body.turning.w * speed + body.damping.y * churn) * turn.z) * body.ease.z
            + gyration.z * (turn.x * turn.y),
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
