// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/rates.rs
// Rates of change of a body's motion in moving air: drag, lift, the lift of turning, added mass, damping.
#import flight/body
#import arith/math
#import arith/vector

struct FlightMotion {
    velocity: vec3<f32>,
    pose: vec4<f32>,
    turning: vec3<f32>,
}

struct AirLoad {
    speed: f32,
    inv_speed: f32,
    q: f32,
    tangent: f32,
    drag: f32,
    lift: f32,
}

struct StillLoad {
    force: vec3<f32>,
    torque: vec3<f32>,
}

fn air_load(body: LeafBody, flow: vec3<f32>) -> AirLoad {
    let squared = max(vec3_dot(flow, flow), TINY_SQUARED);
    let inv_speed = inverse_sqrt(squared);
    let speed = squared * inv_speed;
    let across2 = flow.x * flow.x;
    let along2 = flow.z * flow.z;
    let tangent = across2 + along2;
    let incidence = flow.y * inv_speed;
    let q = incidence * incidence;

    let drag = (body.air_per_m * 0.5) * ((q * (DRAG_RISE - q * DRAG_BEND) + body.edge_drag) * speed);
    let slope =
        q + (body.lift_slope_across * across2 + body.lift_slope_along * along2) * (inv_speed * inv_speed);
    let lift = (body.air_per_m * slope) * ((q * (q * LIFT_BEND + LIFT_RISE) + LIFT_EDGE) * incidence);
    return AirLoad(speed, inv_speed, q, tangent, drag, lift);
}

fn still_load(body: LeafBody, flow: vec3<f32>) -> StillLoad {
    let load = air_load(body, flow);
    let push = load.lift * flow.y - load.drag;
    let force = vec3<f32>(
        push * flow.x,
        -(load.lift * load.tangent + load.drag * flow.y),
        push * flow.z,
    );
    let munk = (body.added_mass * flow.y) * (load.q * MUNK_RISE + MUNK_EDGE);
    let lever = vec3_cross(body.centroid, force);
    let twist = body.twist_m * (load.speed * flow.y);
    return StillLoad(force, vec3<f32>(lever.x + munk * flow.z, lever.y + twist, lever.z - munk * flow.x));
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
    let flow = u + vec3_cross(turn, body.centroid);
    let load = air_load(body, flow);
    let speed = load.speed;
    let inv_speed = load.inv_speed;
    let q = load.q;
    let tangent = load.tangent;
    let drag = load.drag;
    let lift = load.lift;
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl = vec3_cross(
        vec3<f32>((body.air_along * circulation) * turn.x, 0.0, (body.air_across * circulation) * turn.z),
        flow,
    );
    let force = vec3<f32>(
        whirl.x + (lift * flow.y - drag) * flow.x,
        whirl.y - (lift * tangent + drag * flow.y),
        whirl.z + (lift * flow.y - drag) * flow.z,
    );

    let added_momentum = body.added_mass * flow.y;
    let push = vec3<f32>(force.x + added_momentum * turn.z, force.y, force.z - added_momentum * turn.x);
    let munk = added_momentum * (q * MUNK_RISE + MUNK_EDGE);
    let edge_x = body.half_along_m * turn.x;
    let edge_z = body.half_across_m * turn.z;
    let edge = max(edge_x * edge_x + edge_z * edge_z, TINY_SQUARED);
    let damping = (edge * inverse_sqrt(edge)) * DAMPING_TURN;
    let roll = (inv_speed * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (inv_speed * (q * body.pitch_damping)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * body.half_mean_m;
    let wheeling = (speed + max(wheel, -wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.centroid, push);
    let torque = vec3<f32>(
        (lever.x + munk * flow.z) - body.air_along * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + body.twist_m * (speed * flow.y))
            - (body.air_along * body.half_across_m) * (wheeling * turn.y),
        (lever.z - munk * flow.x) - body.air_across * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
    );
    let angular_accel = vec3<f32>(
        torque.x * body.inv_inertia.x + body.gyration.x * (turn.y * turn.z),
        torque.y * body.inv_inertia.y + body.gyration.y * (turn.z * turn.x),
        torque.z * body.inv_inertia.z + body.gyration.z * (turn.x * turn.y),
    );

    let weight = scene.gravity_m_s2;
    let size = body.inv_size_ratio;
    let frame_accel = (turn.z * u.x - turn.x * u.z) * size;
    let centroid_accel = body.centroid.x * angular_accel.z - body.centroid.z * angular_accel.x;
    let normal_accel = ((push.y - weight * normal.y) - frame_accel) + centroid_accel;
    let normal_force = body.resistance * normal_accel;
    let inner = vec3<f32>(
        push.x - weight * across.y,
        (push.y - weight * normal.y) - normal_force,
        push.z - weight * along.y,
    );
    let acceleration = across * inner.x + normal * inner.y + along * inner.z;
    let turning = vec3<f32>(
        angular_accel.x + (normal_force * body.centroid.z) * body.inv_inertia.x,
        angular_accel.y,
        angular_accel.z - (normal_force * body.centroid.x) * body.inv_inertia.z,
    );

    let half = turn * (size * 0.5);
    let pose = vec4<f32>(
        w * half.x + (y * half.z - z * half.y),
        w * half.y + (z * half.x - x * half.z),
        w * half.z + (x * half.y - y * half.x),
        -(x * half.x + y * half.y + z * half.z),
    );
    return FlightMotion(acceleration, pose, turning);
}
