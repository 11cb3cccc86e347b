// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of the flight model: one set for all bodies.
//!
//! # Source
//! Fitted to edge-on drops of paper discs (Howison, Hughes and Iida 2020); the form of the forces is that of Andersen,
//! Pesavento and Wang (2005).

/// Drag edge-on.
pub const EDGE_DRAG: f64 = 0.44;
/// Drag broadside.
pub const BROADSIDE_DRAG: f64 = 2.15;
/// Lift of a flow along the blade.
pub const LIFT: f64 = 1.10;
/// Lift of turning.
pub const ROTATION_LIFT: f64 = 0.88;
/// Added mass and inertia relative to those of a disc in potential flow.
pub const ADDED_MASS: f64 = 0.54;
/// Damping of turning that grows with speed.
pub const SPEED_DAMPING: f64 = 0.025;
/// Damping of turning that grows with turning.
pub const SPIN_DAMPING: f64 = 0.20;
/// Torque of a fully twisted blade about its normal.
pub const TWIST_TORQUE: f64 = 0.2;
/// Share of its speed that drag may take from a body in a step: three quarters above it the steps blow up.
pub const DRAG_BORNE: f64 = 1.6;
/// Angle in rad by which the flow may swing a body within its oscillation in a step: at 2.8 the steps blow up.
pub const SWING_BORNE_RAD: f64 = 1.5;
/// Angle in rad that a body may turn by in a step.
pub const SPIN_BORNE_RAD: f64 = 0.6;
