// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/rates.wgsl
//!
//! Rates of change of a body's motion in moving air: forces along the normal and the blade, the lift of turning, added
//! mass, damping.

use super::body::LeafBody;
use crate::arith::lane::Real;
use crate::arith::math::inverse_sqrt;
use crate::arith::quaternion::Quat;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::context::Context;
use crate::flight::coefficients::{
    DAMPING_NORMAL, DAMPING_ROLL, DAMPING_TURN, MUNK_EDGE, MUNK_RISE, NORMAL_BEND, NORMAL_EDGE, NORMAL_RISE,
    PITCH_EDGE, TANGENT_BEND, TANGENT_RISE, TANGENT_SPIN, WHIRL_EDGE, WHIRL_RISE,
};

/// Motion of a body, or of eight of them; or its rates of change.
#[derive(Clone, Copy, Debug)]
pub struct FlightMotion<R: Real = f32> {
    /// Velocity in m/s, y up.
    pub velocity: Vec3<R>,
    /// Orientation; of unit length but for what the stages of a step leave.
    pub pose: Quat<R>,
    /// Spin about the leaf's own axes times its size ratio, in rad/s.
    pub turning: Vec3<R>,
}

/// Flow past a body, and what it pushes and lifts the body with.
#[derive(Clone, Copy, Debug)]
pub struct AirLoad<R: Real = f32> {
    /// Speed of the flow in m/s.
    pub speed: R,
    /// Its inverse.
    pub inv_speed: R,
    /// Squared sine of the incidence.
    pub q: R,
    /// Force over mass along the normal, per velocity along it: against it, thus negative.
    pub normal: R,
    /// Force over mass along the blade, per velocity along it.
    pub tangent: R,
}

/// Load of a flow past a body, whose velocity is in the leaf's frame, and whose edges move at a speed of their own.
#[inline(always)]
pub fn air_load<R: Real>(body: &LeafBody<R>, flow: Vec3<R>, edge_speed: R) -> AirLoad<R> {
    let one = |value: f32| flow.x.all(value);
    let squared = vec3_dot(flow, flow).max(one(TINY_SQUARED));
    let inv_speed = inverse_sqrt(squared);
    let speed = squared * inv_speed;
    let (across2, along2) = (flow.x * flow.x, flow.z * flow.z);
    let incidence = flow.y * inv_speed;
    let q = incidence * incidence;
    let slope =
        q + (body.lift_slope_across * across2 + body.lift_slope_along * along2) * (inv_speed * inv_speed);

    let edge_on = body.edge_drag * 0.5;
    let against = body.air_per_m * -1.0;
    let pressed = slope * NORMAL_EDGE + q * (q * NORMAL_BEND + NORMAL_RISE);
    let dragged = (q * (q * TANGENT_BEND + TANGENT_RISE) + edge_on) * speed + edge_speed * TANGENT_SPIN;
    AirLoad {
        speed,
        inv_speed,
        q,
        normal: against * ((pressed + edge_on) * speed),
        tangent: against * dragged,
    }
}

/// Force over mass and torque over mass of a flow past a body that does not turn, in the leaf's frame; the torque is that of a leaf
/// of nominal size.
#[inline(always)]
pub fn still_load(body: &LeafBody, flow: Vec3) -> (Vec3, Vec3) {
    let AirLoad { speed, q, normal, tangent, .. } = air_load(body, flow, 0.0);
    let force = Vec3::new(tangent * flow.x, normal * flow.y, tangent * flow.z);
    let munk = (body.added_mass * flow.y) * (q * MUNK_RISE + MUNK_EDGE);
    let lever = vec3_cross(body.centroid, force);
    let twist = body.twist_m * (speed * flow.y);
    let screw = body.screw_m * (speed * flow.z);
    (force, Vec3::new(lever.x + munk * flow.z, lever.y + twist, (lever.z - munk * flow.x) + screw))
}

/// Rates of change of the motion of a body in wind; the pose's is that of its four components.
#[inline(always)]
pub fn flight_rates<R: Real>(
    cx: &Context<'_>,
    body: &LeafBody<R>,
    motion: &FlightMotion<R>,
    wind: Vec3<R>,
) -> FlightMotion<R> {
    let Quat { x, y, z, w } = motion.pose;
    let (x2, y2, z2) = (x + x, y + y, z + z);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    let one = x.all(1.0);
    // Columns of the rotation: the leaf's axes.
    let across = Vec3::new(one - (yy + zz), xy + wz, xz - wy);
    let normal = Vec3::new(xy - wz, one - (xx + zz), yz + wx);
    let along = Vec3::new(xz + wy, yz - wx, one - (xx + yy));

    let relative = motion.velocity - wind;
    let u = Vec3::new(vec3_dot(across, relative), vec3_dot(normal, relative), vec3_dot(along, relative));
    let turn = motion.turning;
    let flow = u + vec3_cross(turn, body.centroid);
    let (edge_x, edge_z) = (body.half_along_m * turn.x, body.half_across_m * turn.z);
    let edge_squared = (edge_x * edge_x + edge_z * edge_z).max(x.all(TINY_SQUARED));
    let edge = edge_squared * inverse_sqrt(edge_squared);
    let AirLoad { speed, inv_speed, q, normal: pressure, tangent } = air_load(body, flow, edge);
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl = circulation * ((body.air_across * turn.z) * flow.x - (body.air_along * turn.x) * flow.z);
    let force = Vec3::new(tangent * flow.x, whirl + pressure * flow.y, tangent * flow.z);

    // Added mass, but for its resistance to acceleration along the normal.
    let munk = (body.added_mass * flow.y) * (q * MUNK_RISE + MUNK_EDGE);
    let damping = edge * DAMPING_TURN + body.viscous_m_s;
    let roll = (inv_speed * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (inv_speed * (q * body.pitch_damping + PITCH_EDGE)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * body.half_mean_m;
    let wheeling = (speed + wheel.max(x.all(0.0) - wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.centroid, force);
    let torque = Vec3::new(
        (lever.x + munk * flow.z) - body.air_along * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + body.twist_m * (speed * flow.y))
            - (body.air_along * body.half_across_m) * (wheeling * turn.y),
        ((lever.z - munk * flow.x) + body.screw_m * (speed * flow.z))
            - body.air_across * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
    );
    let angular_accel = Vec3::new(
        torque.x * body.inv_inertia.x + body.gyration.x * (turn.y * turn.z),
        torque.y * body.inv_inertia.y + body.gyration.y * (turn.z * turn.x),
        torque.z * body.inv_inertia.z + body.gyration.z * (turn.x * turn.y),
    );

    // The resistance acts at the centroid: on the body's fall and, if its mass is not centred there, on its turning.
    let weight = x.all(cx.scene.gravity_m_s2);
    let size = body.inv_size_ratio;
    let frame_accel = (turn.z * u.x - turn.x * u.z) * size;
    let centroid_accel = body.centroid.x * angular_accel.z - body.centroid.z * angular_accel.x;
    let normal_accel = ((force.y - weight * normal.y) - frame_accel) + centroid_accel;
    let normal_force = body.resistance * normal_accel;
    let inner = Vec3::new(
        force.x - weight * across.y,
        (force.y - weight * normal.y) - normal_force,
        force.z - weight * along.y,
    );
    let acceleration = across * inner.x + normal * inner.y + along * inner.z;
    let turning = Vec3::new(
        angular_accel.x + (normal_force * body.centroid.z) * body.inv_inertia.x,
        angular_accel.y,
        angular_accel.z - (normal_force * body.centroid.x) * body.inv_inertia.z,
    );

    let half = turn * (size * 0.5);
    let pose = Quat::new(
        w * half.x + (y * half.z - z * half.y),
        w * half.y + (z * half.x - x * half.z),
        w * half.z + (x * half.y - y * half.x),
        x.all(0.0) - (x * half.x + y * half.y + z * half.z),
    );
    FlightMotion { velocity: acceleration, pose, turning }
}
