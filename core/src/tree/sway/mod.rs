// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How trees sway: articulated bodies with springs in their joints, driven by the one wind.
//!
//! A segment is a rigid body on a ball joint at the end of its parent. A step goes through a tree twice. Towards the foot
//! ([`inward`]): every segment adds up its own inertia and loads ([`load`]) and what its children hand down, works out how
//! its joint will answer, and hands the rest to its parent. Towards the tips ([`outward`]): every joint, knowing what its
//! parent does, accelerates and moves on. Springs, their damping and the air's drag are taken at the end of the step, so
//! no wind, stiffness or step length makes them pump energy.
//!
//! Two simpler schemes are kept for comparison: [`quigley`] and [`oliapuram_kumar`].
//!
//! # Source
//! Articulated-body algorithm: Featherstone, "Rigid Body Dynamics Algorithms" (2008), chapter 7; here about each joint's
//! own point, in world axes, with classical accelerations.

mod body;
pub mod composite;
pub mod inward;
pub mod load;
pub mod oliapuram_kumar;
pub mod outward;
pub mod quigley;
pub mod row;
pub mod twig;

pub use body::{
    ArticulatedInertia, Body, Constants, Joint, JointResponse, Load, Spring, TwigResponse, VelocityProducts,
};

crate::shared_constants! {
    /// Where in a step springs act: 1/2 is the trapezoidal rule, which keeps slow sways alive; above it, fast ones that
    /// the step cannot follow die away.
    pub const IMPLICITNESS: f32 = 0.6;
    /// Acceleration of gravity in m/s².
    pub const GRAVITY_M_S2: f32 = 9.81;
    /// Angle in rad from which a joint stiffens. No wind bends sound wood that far between two joints; joints that are
    /// far too soft lean on it.
    pub const STOP_ANGLE: f32 = 0.7;
    /// Stiffness from there on per moment of inertia of what the joint carries, in 1/s².
    pub const STOP_STIFFNESS: f32 = 900.0;
    /// Damping of the stop per its stiffness, in s.
    pub const STOP_DAMPING: f32 = 0.2;
    /// Sine of half the largest angle of a joint, a sixth of a turn.
    pub const JOINT_LIMIT: f32 = 0.5;
    /// Cosine of it.
    pub const JOINT_LIMIT_COSINE: f32 = 0.866_025_4;
    /// Largest turn of a joint in one step in rad; again only joints far too soft come near.
    pub const TURN_LIMIT: f32 = 1.0;
    /// Scheme of articulated bodies.
    pub const SCHEME_ARTICULATED: u32 = 0;
    /// Quigley's scheme.
    pub const SCHEME_QUIGLEY: u32 = 1;
    /// Oliapuram and Kumar's scheme.
    pub const SCHEME_OLIAPURAM_KUMAR: u32 = 2;
    /// A third.
    pub const THIRD: f32 = 1.0 / 3.0;
}
