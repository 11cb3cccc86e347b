// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sway dynamics of trees: Featherstone's articulated-body algorithm with implicit springs in the joints, driven by the
//! wind that leaves feel too.
//!
//! A segment is a rigid body on a ball joint at the end of its parent. A step makes two passes over a tree. The inward
//! pass ([`inward`]), from the twigs to the trunk, adds a segment's own inertia and load ([`load`]) to what its children
//! pass on, computes the response of its joint, and passes the inertia and bias force that remain through the joint on to
//! its parent. The outward pass ([`outward`]), from the trunk to the twigs, computes every joint's acceleration from its
//! parent's and integrates it. Springs, their damping and drag act implicitly, so no wind, stiffness or step length makes
//! them pump energy. Where a scene consents, joints are solved in every other step only, and [`coast`] moves segments in between.
//!
//! Two simpler schemes that step joints one by one are kept for comparison: [`quigley`] and [`oliapuram_kumar`].
//!
//! # Source
//! Articulated-body algorithm: Featherstone, "Rigid Body Dynamics Algorithms" (2008), chapter 7; here about each joint's
//! own point, in world axes, with classical accelerations.

mod body;
pub mod coast;
pub mod composite;
pub mod inward;
pub mod load;
pub mod oliapuram_kumar;
pub mod outward;
pub mod quigley;
pub mod row;
pub mod twig;
pub mod work;

pub use body::{
    ArticulatedInertia, Body, Constants, Joint, JointResponse, Load, Spring, TwigResponse, VelocityProducts,
};

crate::shared_constants! {
    /// Share of the step at which springs act: 1/2 is the trapezoidal rule, which does not damp slow sway; a larger one
    /// damps oscillations that are too fast for the step.
    pub const IMPLICITNESS: f32 = 0.6;
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
    /// One third: a rod's moment of inertia about its end is a third of `m l²`.
    pub const THIRD: f32 = 1.0 / 3.0;
}
