// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/rates.rs
// Rates of change of a body's motion in moving air: forces along the normal and the blade, the lift of turning, added mass, damping.
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
    normal: f32,
    tangent: f32,
}

struct StillLoad {
    force: vec3<f32>,
    torque: vec3<f32>,
}

fn air_load(body: LeafBody, flow: vec3<f32>, edge_speed: f32) -> AirLoad {
    let squared = max(vec3_dot(flow, flow), TINY_SQUARED);
    let inv_speed = inverse_sqrt(squared);
    let speed = squared * inv_speed;
    let across2 = flow.x * flow.x;
    let along2 = flow.z * flow.z;
    let incidence = flow.y * inv_speed;
    let q = incidence * incidence;
    let slope =
        q + (body.lift_slope_across * across2 + body.lift_slope_along * along2) * (inv_speed * inv_speed);

    let edge_on = body.edge_drag * 0.5;
    let against = body.air_per_m * -1.0;
    let pressed = slope * NORMAL_EDGE + q * (q * NORMAL_BEND + NORMAL_RISE);
    let dragged = (q * (q * TANGENT_BEND + TANGENT_RISE) + edge_on) * speed + edge_speed * TANGENT_SPIN;
    return AirLoad(
        speed,
        inv_speed,
        q,
        against * ((pressed + edge_on) * speed),
        against * dragged,
    );
}

fn still_load(body: LeafBody, flow: vec3<f32>) -> StillLoad {
    let load = air_load(body, flow, 0.0);
    let force = vec3<f32>(load.tangent * flow.x, load.normal * flow.y, load.tangent * flow.z);
    let munk = (body.added_mass * flow.y) * (load.q * MUNK_RISE + MUNK_EDGE);
    let lever = vec3_cross(body.centroid, force);
    let twist = body.twist_m * (load.speed * flow.y);
    let screw = body.screw_m * (load.speed * flow.z);
    let torque = vec3<f32>(lever.x + munk * flow.z, lever.y + twist, (lever.z - munk * flow.x) + screw);
    return StillLoad(force, torque);
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
    let edge_x = body.half_along_m * turn.x;
    let edge_z = body.half_across_m * turn.z;
    let edge_squared = max(edge_x * edge_x + edge_z * edge_z, TINY_SQUARED);
    let edge = edge_squared * inverse_sqrt(edge_squared);
    let load = air_load(body, flow, edge);
    let speed = load.speed;
    let inv_speed = load.inv_speed;
    let q = load.q;
    let tangent = load.tangent;
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl =
        circulation * ((body.air_across * turn.z) * flow.x - (body.air_along * turn.x) * flow.z);
    let force = vec3<f32>(tangent * flow.x, whirl + load.normal * flow.y, tangent * flow.z);

    let munk = (body.added_mass * flow.y) * (q * MUNK_RISE + MUNK_EDGE);
    let damping = edge * DAMPING_TURN + body.viscous_m_s;
    let roll = (inv_speed * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (inv_speed * (q * body.pitch_damping + PITCH_EDGE)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * body.half_mean_m;
    let wheeling = (speed + max(wheel, -wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.centroid, force);
    let torque = vec3<f32>(
        (lever.x + munk * flow.z) - body.air_along * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + body.twist_m * (speed * flow.y))
            - (body.air_along * body.half_across_m) * (wheeling * turn.y),
        ((lever.z - munk * flow.x) + body.screw_m * (speed * flow.z))
            - body.air_across * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
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
    let normal_accel = ((force.y - weight * normal.y) - frame_accel) + centroid_accel;
    let normal_force = body.resistance * normal_accel;
    let inner = vec3<f32>(
        force.x - weight * across.y,
        (force.y - weight * normal.y) - normal_force,
        force.z - weight * along.y,
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
