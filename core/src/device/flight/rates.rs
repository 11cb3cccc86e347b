// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/rates.wgsl
//!
//! Rates of change of a body's motion in moving air: drag, lift, the lift of turning, added mass, damping.

use super::body::LeafBody;
use crate::arith::lane::Real;
use crate::arith::math::inverse_sqrt;
use crate::arith::quaternion::Quat;
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};
use crate::context::Context;
use crate::flight::coefficients::{
    DAMPING_NORMAL, DAMPING_ROLL, DAMPING_TURN, DRAG_BEND, DRAG_RISE, LIFT_BEND, LIFT_EDGE, LIFT_RISE,
    MUNK_EDGE, MUNK_RISE, WHIRL_EDGE, WHIRL_RISE,
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
    /// Squared speed within the plane of the blade.
    pub tangent: R,
    /// Drag over mass per velocity.
    pub drag: R,
    /// Lift over mass per product of velocities.
    pub lift: R,
}

/// Load of a flow past a body, whose velocity is in the leaf's frame.
#[inline(always)]
pub fn air_load<R: Real>(body: &LeafBody<R>, flow: Vec3<R>) -> AirLoad<R> {
    let one = |value: f32| flow.x.all(value);
    let squared = vec3_dot(flow, flow).max(one(TINY_SQUARED));
    let inv_speed = inverse_sqrt(squared);
    let speed = squared * inv_speed;
    let (across2, along2) = (flow.x * flow.x, flow.z * flow.z);
    let tangent = across2 + along2;
    let incidence = flow.y * inv_speed;
    let q = incidence * incidence;

    let drag = (body.air_per_m * 0.5) * ((q * (one(DRAG_RISE) - q * DRAG_BEND) + body.edge_drag) * speed);
    let slope =
        q + (body.lift_slope_across * across2 + body.lift_slope_along * along2) * (inv_speed * inv_speed);
    let lift = (body.air_per_m * slope) * ((q * (q * LIFT_BEND + LIFT_RISE) + LIFT_EDGE) * incidence);
    AirLoad { speed, inv_speed, q, tangent, drag, lift }
}

/// Force over mass and torque over mass of a flow past a body that does not turn, in the leaf's frame; the torque is that of a leaf
/// of nominal size.
#[inline(always)]
pub fn still_load(body: &LeafBody, flow: Vec3) -> (Vec3, Vec3) {
    let AirLoad { speed, q, tangent, drag, lift, .. } = air_load(body, flow);
    let force = Vec3::new(
        (lift * flow.y - drag) * flow.x,
        -(lift * tangent + drag * flow.y),
        (lift * flow.y - drag) * flow.z,
    );
    let munk = (body.added_mass * flow.y) * (q * MUNK_RISE + MUNK_EDGE);
    let lever = vec3_cross(body.centroid, force);
    let twist = body.twist_m * (speed * flow.y);
    (force, Vec3::new(lever.x + munk * flow.z, lever.y + twist, lever.z - munk * flow.x))
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
    let AirLoad { speed, inv_speed, q, tangent, drag, lift } = air_load(body, flow);
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl = vec3_cross(
        Vec3::new(
            (body.air_along * circulation) * turn.x,
            x.all(0.0),
            (body.air_across * circulation) * turn.z,
        ),
        flow,
    );
    let force = Vec3::new(
        whirl.x + (lift * flow.y - drag) * flow.x,
        whirl.y - (lift * tangent + drag * flow.y),
        whirl.z + (lift * flow.y - drag) * flow.z,
    );

    // Added mass, but for its resistance to acceleration along the normal.
    let added_momentum = body.added_mass * flow.y;
    let push = Vec3::new(force.x + added_momentum * turn.z, force.y, force.z - added_momentum * turn.x);
    let munk = added_momentum * (q * MUNK_RISE + MUNK_EDGE);
    let (edge_x, edge_z) = (body.half_along_m * turn.x, body.half_across_m * turn.z);
    let edge = (edge_x * edge_x + edge_z * edge_z).max(x.all(TINY_SQUARED));
    let damping = (edge * inverse_sqrt(edge)) * DAMPING_TURN;
    let roll = (inv_speed * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (inv_speed * (q * body.pitch_damping)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * body.half_mean_m;
    let wheeling = (speed + wheel.max(x.all(0.0) - wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.centroid, push);
    let torque = Vec3::new(
        (lever.x + munk * flow.z) - body.air_along * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + body.twist_m * (speed * flow.y))
            - (body.air_along * body.half_across_m) * (wheeling * turn.y),
        (lever.z - munk * flow.x) - body.air_across * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
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
    let normal_accel = ((push.y - weight * normal.y) - frame_accel) + centroid_accel;
    let normal_force = body.resistance * normal_accel;
    let inner = Vec3::new(
        push.x - weight * across.y,
        (push.y - weight * normal.y) - normal_force,
        push.z - weight * along.y,
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
