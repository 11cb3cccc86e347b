// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of the flight model: one set for all bodies, drops and sizes.
//!
//! q is the squared sine of the incidence, 0 edge-on and 1 broadside.
//!
//! # Source
//! Fitted to drops of paper discs from 3.5 to 9.4 cm, let go broadside and edge-on (Howison, Hughes and Iida 2020).

crate::shared_constants! {
    /// Gain of the drag with q.
    pub const DRAG_RISE: f32 = 5.52;
    /// Loss of the drag with the square of q: separated flow resists most at middling incidence.
    pub const DRAG_BEND: f32 = 3.0;
    /// Lift per product of sine and cosine of the incidence, edge-on.
    pub const LIFT_EDGE: f32 = 1.30;
    /// Its gain with q.
    pub const LIFT_RISE: f32 = -0.37;
    /// Its gain with the square of q: it stalls.
    pub const LIFT_BEND: f32 = -0.69;
    /// Lift of turning, edge-on.
    pub const WHIRL_EDGE: f32 = 0.56;
    /// Its gain with q.
    pub const WHIRL_RISE: f32 = 0.68;
    /// Share of the torque of potential flow that turns a body broadside, edge-on.
    pub const MUNK_EDGE: f32 = 0.50;
    /// Its gain with q: the centre of pressure moves to the centroid.
    pub const MUNK_RISE: f32 = -0.45;
    /// Damping of turning.
    pub const DAMPING_TURN: f32 = 0.34;
    /// Damping of rolling about the direction of slip, as of a wing as short as broad. It keeps the axis of tumbling level.
    pub const DAMPING_ROLL: f32 = 0.22;
    /// Damping of turning about the normal.
    pub const DAMPING_NORMAL: f32 = 0.03;
}

/// Torque of a fully twisted blade about its normal.
pub const TWIST_TORQUE: f64 = 0.2;
/// Spread of the place of the forces along the normal, per spread within the blade.
pub const ASYMMETRY_CURL: f64 = 1.5;
/// Share of its speed that drag may take from a body in a step: three quarters above it the steps blow up.
pub const DRAG_BORNE: f64 = 1.6;
/// Angle in rad by which the flow may swing a body within its oscillation in a step: at 2.8 the steps blow up.
pub const SWING_BORNE_RAD: f64 = 2.0;
/// Angle in rad that a body may turn by in a step, besides what its spin adds to the flow that swings it.
pub const SPIN_BORNE_RAD: f64 = 5.0;
/// Ticks per second of the clock by which a body counts as idle.
pub const TICKS_PER_S: f64 = 16.0;
