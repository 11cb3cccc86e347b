// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The disc in three dimensions, written anew in double precision: reference for the kernels, and for the form that the
//! coefficients came from.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3};
use windfall_core::scene::STANDARD_GRAVITY_M_S2;

const AIR_KG_M3: f64 = 1.2;

/// Coefficients of a disc's forces, as functions of q, the squared sine of the incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscCoefficients {
    /// Force against the velocity along the normal: constant, linear, quadratic.
    pub normal: [f64; 3],
    /// Force against the velocity along the disc: constant, linear, quadratic.
    pub tangent: [f64; 3],
    /// The same for the rim's own speed in place of the disc's.
    pub tangent_spin: f64,
    /// Share of the lift of rotation and of the impulse's change along the disc.
    pub in_plane: f64,
    /// Lift of rotation: constant, linear.
    pub rotation: [f64; 2],
    /// Share of the Munk moment: constant, linear.
    pub munk: [f64; 2],
    /// Share of the added mass and inertia of potential flow.
    pub added: f64,
    /// Damping of rotation about axes in the disc: with speed, with rotation, and in m²/s over the radius.
    pub damping: [f64; 3],
    /// Damping of rolling.
    pub roll: f64,
    /// Damping of pitching: constant, linear.
    pub pitch: [f64; 2],
    /// Damping of rotation about the normal.
    pub about_normal: f64,
}

impl DiscCoefficients {
    /// The earlier form of the model, fitted to planar drops alone: constant coefficients, one damping about all axes in
    /// the disc.
    pub const PLANAR: Self = Self {
        // Half of a drag of 0.44 edge-on and 2.15 broadside, and a lift slope of 1.10.
        normal: [0.22 + 1.10, 0.855 - 1.10, 0.0],
        tangent: [0.22, 0.855 - 1.10, 0.0],
        tangent_spin: 0.0,
        in_plane: 1.0,
        rotation: [0.88, 0.0],
        munk: [1.0, 0.0],
        added: 0.54,
        damping: [0.025, 0.20, 0.0],
        roll: 0.0,
        pitch: [0.0; 2],
        about_normal: 0.0,
    };
}

/// A disc, evenly covered with mass, whose middle may lie off its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafDisc {
    /// Coefficients.
    pub coefficients: DiscCoefficients,
    /// Mass per area in kg/m².
    pub areal_kg_m2: f64,
    /// Radius in m.
    pub radius_m: f64,
    /// Middle of the disc as seen from the centre of mass, in the disc's frame, y its normal, in m.
    pub arm_m: DVec3,
    /// Torque of its twist, about its normal in a flow along that and about z in a flow along z: a coefficient of density, area, radius
    /// and squared speed.
    pub twist: f64,
}

/// A disc's motion, or its rate of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscState {
    /// Place in m, y up.
    pub place: DVec3,
    /// Velocity in m/s.
    pub velocity: DVec3,
    /// Orientation, or the rate of change of its four components.
    pub pose: DQuat,
    /// Spin about the disc's own axes in rad/s.
    pub spin: DVec3,
}

impl DiscState {
    /// This state and so much of a rate.
    #[must_use]
    pub fn after(&self, rates: &Self, seconds: f64) -> Self {
        Self {
            place: self.place + rates.place * seconds,
            velocity: self.velocity + rates.velocity * seconds,
            pose: self.pose + rates.pose * seconds,
            spin: self.spin + rates.spin * seconds,
        }
    }
}

impl LeafDisc {
    /// Rate of change of a state in air of this velocity.
    #[must_use]
    pub fn rates(&self, state: &DiscState, wind: DVec3) -> DiscState {
        let turn = DMat3::from_quat(state.pose.normalize());
        let drift = turn.transpose() * (state.velocity - wind);
        let (spin, normal) = (state.spin, DVec3::Y);
        let flow = drift + spin.cross(self.arm_m);
        let speed = flow.length().max(1e-9);
        let q = flow.y * flow.y / (speed * speed);
        let k = &self.coefficients;
        let radius = self.radius_m;
        let area = PI * radius * radius;
        let mass = self.areal_kg_m2 * area;
        let cube = radius * radius * radius;
        let added_mass = k.added * 8.0 / 3.0 * AIR_KG_M3 * cube;
        let added_inertia = k.added * 16.0 / 45.0 * AIR_KG_M3 * cube * radius * radius;
        let inertia = mass * radius * radius * DVec3::new(0.25, 0.5, 0.25)
            + DVec3::new(added_inertia, 0.0, added_inertia);

        let slip = flow - normal * flow.y;
        let spun = spin - normal * spin.y;
        let pressed = k.normal[0] + k.normal[1] * q + k.normal[2] * q * q;
        let dragged = (k.tangent[0] + k.tangent[1] * q + k.tangent[2] * q * q) * speed
            + k.tangent_spin * radius * spun.length();
        let circulation = (k.rotation[0] + k.rotation[1] * q) * radius;
        let whirl = circulation * spun.cross(flow);
        let force = AIR_KG_M3
            * area
            * (of_normal(whirl, k.in_plane) - (speed * pressed * flow.y * normal + dragged * slip));
        // The impulse of the air that is carried along, but for its acceleration along the normal.
        let impulse = added_mass * flow.y * normal;
        let push = force - of_normal(spin.cross(impulse), k.in_plane);
        let munk = -(k.munk[0] + k.munk[1] * q) * flow.cross(impulse);
        let across = slip.cross(normal);
        let pitching = k.pitch[0] + k.pitch[1] * q;
        let damping = (k.damping[0] * speed + k.damping[1] * radius * spun.length() + k.damping[2] / radius)
            * spun
            + k.roll / speed * spun.dot(slip) * slip
            + pitching / speed * spun.dot(across) * across
            + k.about_normal * (speed + radius * spin.y.abs()) * spin.y * normal;
        let screw = self.twist * radius * speed * DVec3::new(0.0, flow.y, flow.z);
        let torque = self.arm_m.cross(push) + munk + AIR_KG_M3 * area * (screw - radius * radius * damping);

        // The air resists the acceleration of the middle along the normal. Motion is linear in that resistance, so two
        // trials give it.
        let weight = turn.transpose() * DVec3::new(0.0, -f64::from(STANDARD_GRAVITY_M_S2) * mass, 0.0);
        let moved = |resistance: f64| {
            let reaction = -resistance * normal;
            let acceleration = (push + weight + reaction) / mass;
            let turned = (torque + self.arm_m.cross(reaction) - spin.cross(inertia * spin)) / inertia;
            let middle = acceleration - spin.cross(drift) + turned.cross(self.arm_m);
            (acceleration, turned, added_mass * middle.y)
        };
        let (none, one) = (moved(0.0).2, moved(1.0).2);
        let (acceleration, turned, _) = moved(none / (1.0 - (one - none)));
        DiscState {
            place: state.velocity,
            velocity: turn * acceleration,
            pose: state.pose * DQuat::from_xyzw(0.5 * spin.x, 0.5 * spin.y, 0.5 * spin.z, 0.0),
            spin: turned,
        }
    }

    /// The state one classical Runge-Kutta step later.
    #[must_use]
    pub fn step(&self, state: &DiscState, wind: DVec3, seconds: f64) -> DiscState {
        let k1 = self.rates(state, wind);
        let k2 = self.rates(&state.after(&k1, 0.5 * seconds), wind);
        let k3 = self.rates(&state.after(&k2, 0.5 * seconds), wind);
        let k4 = self.rates(&state.after(&k3, seconds), wind);
        let end = state.after(&k1, seconds / 6.0).after(&k2, seconds / 3.0);
        let end = end.after(&k3, seconds / 3.0).after(&k4, seconds / 6.0);
        DiscState { pose: end.pose.normalize(), ..end }
    }
}

/// A vector of which only a share is left along the disc.
fn of_normal(vector: DVec3, in_plane: f64) -> DVec3 {
    vector * DVec3::new(in_plane, 1.0, in_plane)
}
