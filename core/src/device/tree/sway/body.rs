// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/body.wgsl
//!
//! Types of the articulated-body algorithm: a segment's constants, state and inertia, and the response of its joint.

use crate::arith::lane::each_number;
use crate::arith::{Mat3, Quat, Sym3, Vec3};
use crate::tree::record::SegmentConstants;

/// Constants of a segment, or of several in the lanes of `R`: the floats of [`SegmentConstants`].
///
/// Rest and offset, all that the outward pass reads, come first in memory.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the fields of SegmentConstants")]
#[repr(C)]
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
}

each_number!(Constants {
    length, mass, first_moment, inertia_across, inertia_along, leaf_mass, wood_drag, leaf_drag, leaf_yield, damping,
    bending, twisting;
    rest, offset, preload
});

impl From<&SegmentConstants> for Constants {
    #[inline(always)]
    fn from(segment: &SegmentConstants) -> Self {
        Self {
            rest: segment.rest.into(),
            offset: segment.offset.into(),
            length: segment.length,
            mass: segment.mass,
            first_moment: segment.first_moment,
            inertia_across: segment.inertia_across,
            inertia_along: segment.inertia_along,
            leaf_mass: segment.leaf_mass,
            wood_drag: segment.wood_drag,
            leaf_drag: segment.leaf_drag,
            leaf_yield: segment.leaf_yield,
            preload: segment.preload.into(),
            damping: segment.damping,
            bending: segment.bending,
            twisting: segment.twisting,
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

/// Pose and velocity of a segment.
#[derive(Clone, Copy, Debug)]
pub struct Body<R = f32> {
    /// Position of its joint in m.
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

/// Articulated-body inertia and bias force of a segment with everything that grows from it, about its joint, in world
/// axes: Featherstone's `Iᴬ` and `pᴬ` in blocks of three.
#[derive(Clone, Copy, Debug)]
pub struct ArticulatedInertia<R = f32> {
    /// Torque per angular acceleration in kg m².
    pub rotation: Sym3<R>,
    /// Torque per acceleration in kg m; transposed, force per angular acceleration.
    pub coupling: Mat3<R>,
    /// Force per acceleration in kg.
    pub mass: Sym3<R>,
    /// Bias torque in N m: what it takes to keep the body from accelerating.
    pub moment: Vec3<R>,
    /// Bias force in N.
    pub force: Vec3<R>,
}

/// Rigid-body inertia and bias force of a segment by itself about its joint, in world axes; the inertia is symmetric about
/// the segment's axis.
#[derive(Clone, Copy, Debug)]
pub struct Load<R = f32> {
    /// Moment of inertia about the axis in kg m².
    pub rotation_along: R,
    /// Moment of inertia about the joint across the axis in kg m².
    pub rotation_across: R,
    /// First moment along the axis in kg m.
    pub coupling: R,
    /// Force per acceleration along the axis in kg.
    pub mass_along: R,
    /// Force per acceleration across it in kg.
    pub mass_across: R,
    /// Bias torque in N m: what it takes to keep the body from accelerating.
    pub moment: Vec3<R>,
    /// Bias force in N.
    pub force: Vec3<R>,
}

/// Spring and damper of a joint, implicit in time: the torque at the end of the step is linear in the acceleration.
#[derive(Clone, Copy, Debug)]
pub struct Spring<R = f32> {
    /// Torque in N m in world axes at [`IMPLICITNESS`](super::IMPLICITNESS) of the step if the joint does not accelerate.
    pub torque: Vec3<R>,
    /// Inertia in kg m² that the implicit spring adds against twisting.
    pub along: R,
    /// Inertia in kg m² that it adds against bending.
    pub across: R,
}

/// Velocity-product accelerations of a joint: those that the velocities of the two segments alone bring about (`c` in
/// Featherstone), and the arm that carries the parent's angular acceleration to the joint.
#[derive(Clone, Copy, Debug, Default)]
pub struct VelocityProducts<R = f32> {
    /// Position of the joint relative to the parent's in m.
    pub arm: Vec3<R>,
    /// Angular part in rad/s².
    pub angular: Vec3<R>,
    /// Centripetal acceleration of the joint in m/s².
    pub centripetal: Vec3<R>,
}

each_number!(VelocityProducts { ; arm, angular, centripetal });

/// Response of a twig's joint: a [`JointResponse`] whose matrices are symmetric about the axis.
#[derive(Clone, Copy, Debug, Default)]
pub struct TwigResponse<R = f32> {
    /// Angular acceleration in rad/s² if the parent does not accelerate.
    pub free: Vec3<R>,
    /// Share of the spring in the joint's stiffness against twisting.
    pub spring_along: R,
    /// Share of the spring in the joint's stiffness against bending.
    pub spring_across: R,
    /// Angular acceleration across the axis per acceleration of the joint, opposed, in 1/m.
    pub lever: R,
    /// Velocity-product accelerations.
    pub products: VelocityProducts<R>,
}

each_number!(TwigResponse { spring_along, spring_across, lever; free, products });

/// Angular acceleration of a joint as a linear function of its parent's acceleration, from the inward pass for the
/// outward one.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointResponse<R = f32> {
    /// Angular acceleration in rad/s² if the parent does not accelerate.
    pub free: Vec3<R>,
    /// Share of the spring in the joint's stiffness.
    pub spring: Mat3<R>,
    /// Angular acceleration per acceleration of the joint, opposed, in 1/m.
    pub lever: Mat3<R>,
    /// Velocity-product accelerations.
    pub products: VelocityProducts<R>,
}

each_number!(JointResponse { ; free, spring, lever, products });
