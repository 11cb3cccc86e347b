// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of the flight model: one set for all bodies, drops and sizes.
//!
//! q is the squared sine of the incidence, 0 edge-on and 1 broadside.
//!
//! # Source
//! Fitted to drops of paper discs from 3.5 to 9.4 cm, let go broadside and edge-on (Howison, Hughes and Iida 2020).

crate::shared_constants! {
    /// Drag edge-on.
    pub const DRAG_EDGE: f32 = 0.25;
    /// What the drag gains with q.
    pub const DRAG_RISE: f32 = 5.62;
    /// What it loses with the square of q.
    pub const DRAG_BEND: f32 = 3.8;
    /// Lift per product of sine and cosine of the incidence.
    pub const LIFT_FLAT: f32 = 0.79;
    /// What this gains with the square of q.
    pub const LIFT_STEEP: f32 = 0.69;
    /// Lift of turning edge-on.
    pub const WHIRL_EDGE: f32 = 1.18;
    /// What it gains with q: circulation dies broadside.
    pub const WHIRL_RISE: f32 = -0.95;
    /// Share of the torque of potential flow that turns a body broadside, edge-on.
    pub const MUNK_EDGE: f32 = 0.62;
    /// What it gains with q.
    pub const MUNK_RISE: f32 = -0.7;
    /// Damping of turning that grows with speed.
    pub const DAMPING_SPEED: f32 = 0.03;
    /// Damping of turning that grows with turning.
    pub const DAMPING_TURN: f32 = 0.28;
    /// Damping of rolling about the direction of slip.
    pub const DAMPING_ROLL: f32 = 0.16;
    /// Damping of pitching, per q; negative: the stalled flow drives it.
    pub const DAMPING_PITCH: f32 = -0.87;
    /// Damping of turning about the normal.
    pub const DAMPING_NORMAL: f32 = 0.016;
}

/// Torque of a fully twisted blade about its normal.
pub const TWIST_TORQUE: f64 = 0.2;
/// Share of its speed that drag may take from a body in a step: three quarters above it the steps blow up.
pub const DRAG_BORNE: f64 = 1.6;
/// Angle in rad by which the flow may swing a body within its oscillation in a step: at 2.8 the steps blow up.
pub const SWING_BORNE_RAD: f64 = 1.5;
/// Angle in rad that a body may turn by in a step.
pub const SPIN_BORNE_RAD: f64 = 0.6;
