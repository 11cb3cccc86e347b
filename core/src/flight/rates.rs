// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/rates.wgsl
//!
//! How a body's motion changes in air that moves: drag, lift, the lift of turning, added mass, damping.

use super::body::Body;
use super::coefficients::{
    DAMPING_NORMAL, DAMPING_ROLL, DAMPING_TURN, DRAG_BEND, DRAG_RISE, LIFT_BEND, LIFT_EDGE, LIFT_RISE,
    MUNK_EDGE, MUNK_RISE, WHIRL_EDGE, WHIRL_RISE,
};
use crate::kernel::lane::Real;
use crate::kernel::math::inverse_sqrt;
use crate::kernel::quaternion::Quat;
use crate::kernel::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot};

crate::shared_constants! {
    /// Acceleration of gravity in m/s².
    pub const FLIGHT_GRAVITY: f32 = 9.81;
}

/// How a body moves, or eight of them.
#[derive(Clone, Copy, Debug)]
pub struct Motion<R: Real = f32> {
    /// Velocity in m/s, y up.
    pub velocity: Vec3<R>,
    /// Orientation; of unit length but for what the stages of a step leave.
    pub pose: Quat<R>,
    /// Spin about the leaf's own axes times its size ratio, in rad/s.
    pub turning: Vec3<R>,
}

/// Rates of change of a motion; the pose's is that of its four components.
pub type Rates<R = f32> = Motion<R>;

/// Rates of change of the motion of a body in wind.
#[inline(always)]
pub fn flight_rates<R: Real>(body: &Body<R>, motion: &Motion<R>, wind: Vec3<R>) -> Rates<R> {
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
    let flow = u + vec3_cross(turn, body.arm);
    let squared = vec3_dot(flow, flow).max(x.all(TINY_SQUARED));
    let slowness = inverse_sqrt(squared);
    let speed = squared * slowness;
    let (across2, along2) = (flow.x * flow.x, flow.z * flow.z);
    let tangent = across2 + along2;
    let incidence = flow.y * slowness;
    let q = incidence * incidence;

    let [air, added, air_along, air_across] = body.air;
    let [along_m, across_m, mean_m, twist] = body.reach;
    let [slope_x, slope_z] = body.slope;
    let [pitch_damping, edge_drag] = body.own;
    let resist = (air * 0.5) * ((q * (x.all(DRAG_RISE) - q * DRAG_BEND) + edge_drag) * speed);
    let slope = q + (slope_x * across2 + slope_z * along2) * (slowness * slowness);
    let raise = (air * slope) * ((q * (q * LIFT_BEND + LIFT_RISE) + LIFT_EDGE) * incidence);
    let circulation = q * WHIRL_RISE + WHIRL_EDGE;
    let whirl = vec3_cross(
        Vec3::new((air_along * circulation) * turn.x, x.all(0.0), (air_across * circulation) * turn.z),
        flow,
    );
    let force = Vec3::new(
        whirl.x + (raise * flow.y - resist) * flow.x,
        whirl.y - (raise * tangent + resist * flow.y),
        whirl.z + (raise * flow.y - resist) * flow.z,
    );

    // What the air that moves along adds, but for its resistance to acceleration along the normal.
    let drawn = added * flow.y;
    let push = Vec3::new(force.x + drawn * turn.z, force.y, force.z - drawn * turn.x);
    let munk = drawn * (q * MUNK_RISE + MUNK_EDGE);
    let (edge_x, edge_z) = (along_m * turn.x, across_m * turn.z);
    let edge = (edge_x * edge_x + edge_z * edge_z).max(x.all(TINY_SQUARED));
    let damping = (edge * inverse_sqrt(edge)) * DAMPING_TURN;
    let roll = (slowness * DAMPING_ROLL) * (edge_x * flow.x + edge_z * flow.z);
    let pitch = (slowness * (q * pitch_damping)) * (edge_x * flow.z - edge_z * flow.x);
    let wheel = turn.y * mean_m;
    let wheeling = (speed + wheel.max(x.all(0.0) - wheel)) * DAMPING_NORMAL;
    let lever = vec3_cross(body.arm, push);
    let torque = Vec3::new(
        (lever.x + munk * flow.z) - air_along * (damping * edge_x + (roll * flow.x + pitch * flow.z)),
        (lever.y + twist * (speed * flow.y)) - (air_along * across_m) * (wheeling * turn.y),
        (lever.z - munk * flow.x) - air_across * (damping * edge_z + (roll * flow.z - pitch * flow.x)),
    );
    let freely = Vec3::new(
        torque.x * body.ease.x + body.gyration.x * (turn.y * turn.z),
        torque.y * body.ease.y + body.gyration.y * (turn.z * turn.x),
        torque.z * body.ease.z + body.gyration.z * (turn.x * turn.y),
    );

    // That resistance acts in the middle of the area: on the body's fall and, if this is not where its mass is, on its
    // turning.
    let weight = x.all(FLIGHT_GRAVITY);
    let size = body.size[1];
    let carried = (turn.z * u.x - turn.x * u.z) * size;
    let swung = body.arm.x * freely.z - body.arm.z * freely.x;
    let gathered = ((push.y - weight * normal.y) - carried) + swung;
    let resistance = body.resistance * gathered;
    let inner = Vec3::new(
        push.x - weight * across.y,
        (push.y - weight * normal.y) - resistance,
        push.z - weight * along.y,
    );
    let acceleration = across * inner.x + normal * inner.y + along * inner.z;
    let turning = Vec3::new(
        freely.x + (resistance * body.arm.z) * body.ease.x,
        freely.y,
        freely.z - (resistance * body.arm.x) * body.ease.z,
    );

    let half = turn * (size * 0.5);
    let pose = Quat::new(
        w * half.x + (y * half.z - z * half.y),
        w * half.y + (z * half.x - x * half.z),
        w * half.z + (x * half.y - y * half.x),
        x.all(0.0) - (x * half.x + y * half.y + z * half.z),
    );
    Motion { velocity: acceleration, pose, turning }
}
