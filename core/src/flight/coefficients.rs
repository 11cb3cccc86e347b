// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of the flight model: one set for all bodies, drops and sizes.
//!
//! q is the squared sine of the incidence, 0 edge-on and 1 broadside. Forces along the normal and along the blade act
//! against the velocity there; their coefficients are per that velocity, the speed and the air's mass over the body's area.
//!
//! # Source
//! Fitted to drops of paper discs from 3.5 to 9.4 cm, let go broadside and edge-on (Howison, Hughes and Iida 2020), and to
//! where discs flutter and begin to tumble (Field, Klaus, Moore and Nori 1997). Not fitted: a disc held broadside has its
//! measured drag coefficient, 1.17 (Hoerner 1965), and viscosity damps so that discs fall steadily below a Reynolds number
//! of about 100, as Field and others measured.

crate::shared_constants! {
    /// Force along the normal edge-on, times the slope of lift.
    pub const NORMAL_EDGE: f32 = 1.13;
    /// Its gain with q, whatever the slope of lift.
    pub const NORMAL_RISE: f32 = 0.385;
    /// Its gain with the square of q: the flow separates. Broadside half a drag coefficient of 1.17 remains.
    pub const NORMAL_BEND: f32 = -0.978;
    /// Gain with q of the force along the blade.
    pub const TANGENT_RISE: f32 = 4.07;
    /// Its gain with the square of q.
    pub const TANGENT_BEND: f32 = -4.89;
    /// Force along the blade by the edges' own speed in place of the body's: a turning blade drags air along.
    pub const TANGENT_SPIN: f32 = 0.40;
    /// Lift of turning, along the normal, edge-on.
    pub const WHIRL_EDGE: f32 = 1.39;
    /// Its gain with q.
    pub const WHIRL_RISE: f32 = -1.21;
    /// Share of the torque of potential flow that turns a body broadside, edge-on.
    pub const MUNK_EDGE: f32 = 0.647;
    /// Its gain with q: the centre of pressure moves to the centroid, and past it.
    pub const MUNK_RISE: f32 = -1.104;
    /// Damping of turning.
    pub const DAMPING_TURN: f32 = 0.264;
    /// Damping of turning by viscosity, over half the size: ten times the air's kinematic viscosity.
    pub const DAMPING_VISCOUS_M2_S: f32 = 1.5e-4;
    /// Damping of pitching, edge-on. A body's own is its gain with q.
    pub const PITCH_EDGE: f32 = -0.091;
    /// Damping of rolling about the direction of slip, as of a wing as short as broad. It keeps the axis of tumbling level.
    pub const DAMPING_ROLL: f32 = 0.51;
    /// Damping of turning about the normal.
    pub const DAMPING_NORMAL: f32 = 0.033;
}

/// Torque of a fully twisted blade about its normal.
pub const TWIST_TORQUE: f64 = 0.2;
/// Spread of the place of the forces along the normal, per spread within the blade.
pub const ASYMMETRY_CURL: f64 = 1.5;
/// Share of its speed that drag may take from a body in a step.
pub const DRAG_BORNE: f64 = 1.6;
/// Angle in rad by which the flow may swing a body within its oscillation in a step: at 2.8 the steps blow up.
pub const SWING_BORNE_RAD: f64 = 2.0;
/// Angle in rad that a body may turn by in a step, besides what its spin adds to the flow that swings it.
pub const SPIN_BORNE_RAD: f64 = 5.0;
/// Ticks per second of the clock by which a body counts as idle.
pub const TICKS_PER_S: f64 = 16.0;
