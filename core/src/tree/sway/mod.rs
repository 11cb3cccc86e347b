// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How trees sway: articulated bodies with springs in their joints, driven by the one wind.
//!
//! A segment is a rigid body on a ball joint at the end of its parent. A step goes through a tree twice. Towards the foot
//! ([`fold`]): every segment adds up its own inertia and loads ([`load`]) and what its children hand down, works out how
//! its joint will answer, and hands the rest to its parent. Towards the tips ([`unfold`]): every joint, knowing what its
//! parent does, accelerates and moves on. Springs, their damping and the air's drag are taken at the end of the step, so
//! no wind, stiffness or step length makes them pump energy.
//!
//! Two simpler schemes are kept for comparison: [`quigley`] and [`oliapuram_kumar`].
//!
//! # Source
//! Articulated-body algorithm: Featherstone, "Rigid Body Dynamics Algorithms" (2008), chapter 7; here about each joint's
//! own point, in world axes, with classical accelerations.

pub mod fold;
pub mod load;
pub mod row;
pub mod unfold;

use super::record::Timber;
use crate::kernel::{Mat3, Quat, Sym3, Vec3};

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
    /// A third.
    pub const THIRD: f32 = 1.0 / 3.0;
}

/// Constants of a segment, or of eight: see [`Timber`].
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the fields of Timber")]
pub struct Constants<R = f32> {
    pub rest: Quat<R>,
    pub offset: Vec3<R>,
    pub length: R,
    pub mass: R,
    pub first_moment: R,
    pub inertia_across: R,
    pub inertia_along: R,
    pub leaf_mass: R,
    pub wood_drag: R,
    pub leaf_drag: R,
    pub leaf_yield: R,
    pub preload: Vec3<R>,
    pub damping: R,
    pub bending: R,
    pub twisting: R,
    pub bending_inertia: R,
    pub twisting_inertia: R,
}

impl From<&Timber> for Constants {
    #[inline(always)]
    fn from(timber: &Timber) -> Self {
        Self {
            rest: timber.rest.into(),
            offset: timber.offset.into(),
            length: timber.length,
            mass: timber.mass,
            first_moment: timber.first_moment,
            inertia_across: timber.inertia_across,
            inertia_along: timber.inertia_along,
            leaf_mass: timber.leaf_mass,
            wood_drag: timber.wood_drag,
            leaf_drag: timber.leaf_drag,
            leaf_yield: timber.leaf_yield,
            preload: timber.preload.into(),
            damping: timber.damping,
            bending: timber.bending,
            twisting: timber.twisting,
            bending_inertia: timber.bending_inertia,
            twisting_inertia: timber.twisting_inertia,
        }
    }
}

/// State of a joint.
#[derive(Clone, Copy, Debug)]
pub struct Joint<R = f32> {
    /// Rotation relative to rest, in the segment's frame.
    pub turn: Quat<R>,
    /// Rate in rad/s, in the segment's frame.
    pub rate: Vec3<R>,
}

/// Where a segment is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Body<R = f32> {
    /// Place of its joint in m.
    pub base: Vec3<R>,
    /// Orientation.
    pub pose: Quat<R>,
    /// Velocity of its joint in m/s.
    pub velocity: Vec3<R>,
    /// Angular velocity in rad/s.
    pub spin: Vec3<R>,
}

impl Body {
    /// The ground that trunks grow from.
    pub const GROUND: Self =
        Self { base: Vec3::ZERO, pose: Quat::IDENTITY, velocity: Vec3::ZERO, spin: Vec3::ZERO };
}

/// Inertia of a body and of what it carries, and the force and torque that hold it back, about its joint, in world axes.
#[derive(Clone, Copy, Debug)]
pub struct Articulated<R = f32> {
    /// Torque per angular acceleration in kg m².
    pub rotation: Sym3<R>,
    /// Torque per acceleration in kg m; transposed, force per angular acceleration.
    pub coupling: Mat3<R>,
    /// Force per acceleration in kg.
    pub mass: Sym3<R>,
    /// Torque in N m that no acceleration would take.
    pub moment: Vec3<R>,
    /// Force in N that no acceleration would take.
    pub force: Vec3<R>,
}

/// How a joint answers what its parent does.
#[derive(Clone, Copy, Debug)]
pub struct Answer<R = f32> {
    /// Angular acceleration in rad/s² if the parent does nothing.
    pub free: Vec3<R>,
    /// Share of the spring in the joint's stiffness.
    pub spring: Mat3<R>,
    /// Angular acceleration per acceleration of the joint, opposed, in 1/m.
    pub lever: Mat3<R>,
    /// The joint's place relative to the parent's in m.
    pub arm: Vec3<R>,
    /// Angular acceleration from turning frames in rad/s².
    pub turning: Vec3<R>,
    /// Acceleration from turning frames in m/s².
    pub centripetal: Vec3<R>,
}
