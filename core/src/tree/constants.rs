// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constants of a skeleton's segments from its wood and foliage: masses, inertias, springs, drag.
//!
//! # Source
//! A joint between two half segments in series bends like the beam they cut: E I over half the length each. The sway
//! frequency that damping refers to is Rayleigh's, for the shape that the tree's own weight, turned sideways, gives it.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3, swizzles::Vec3Swizzles};

use super::crown::ground_m2;
use super::record::{NO_SEGMENT, SegmentConstants};
use super::skeleton::{AttachmentKind, Segment, Skeleton};
use crate::convert::single;
use crate::motion::AIR_DENSITY;
use crate::scene::{Foliage, Wood};

/// Shear modulus of green wood per Young's modulus along the grain.
const SHEAR_SHARE: f64 = 1.0 / 14.0;
/// Least moment of inertia about a segment per that across it: side twigs and petioles keep it from being a bare rod.
const LEAST_AXIAL: f64 = 0.01;

/// Area and mass of one leaf of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeafFacts {
    /// Area of the blade in m².
    pub area_m2: f64,
    /// Mass in kg when it falls.
    pub mass_kg: f64,
}

/// Totals of a whole tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeFacts {
    /// Ground area beneath the crown in m².
    pub crown_m2: f64,
    /// Leaves of the full crown per attachment.
    pub leaves_each: f64,
    /// Area of these in m².
    pub leaf_m2: f64,
    /// Mass of the wood in kg.
    pub wood_kg: f64,
    /// Mass of the full crown's leaves in kg.
    pub leaves_kg: f64,
    /// Estimated frequency of the main sway with all leaves in Hz.
    pub sway_hz: f64,
}

/// A segment while its constants are worked out, in the tree's frame.
struct Draft {
    pose: DQuat,
    start: DVec3,
    axis: DVec3,
    length: f64,
    mass: f64,
    first_moment: f64,
    inertia_across: f64,
    inertia_along: f64,
    leaves: u32,
    bending: f64,
}

/// Mass and first moment of a segment with everything that grows from it.
#[derive(Clone, Copy, Default)]
struct Outboard {
    mass: f64,
    moment: DVec3,
}

/// Constants of all segments of a tree in the skeleton's order, links left open, and the totals of the tree.
pub(super) fn segment_constants(
    skeleton: &Skeleton,
    wood: &Wood,
    foliage: &Foliage,
    leaf: LeafFacts,
    gravity_m_s2: f32,
) -> (Vec<SegmentConstants>, TreeFacts) {
    let young = f64::from(wood.youngs_modulus_gpa) * 1e9;
    let mut drafts: Vec<Draft> = Vec::with_capacity(skeleton.segments.len());
    for segment in &skeleton.segments {
        let parent =
            segment.parent.map(|parent| (&skeleton.segments[parent as usize], &drafts[parent as usize]));
        let draft = draft_of(segment, parent, young, f64::from(wood.density_kg_m3));
        drafts.push(draft);
    }
    let leaves: Vec<_> = skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf).collect();
    for attachment in &leaves {
        drafts[attachment.segment as usize].leaves += 1;
    }
    let crown_m2 = crown_area(skeleton, leaf);
    let count = leaves.len() as f64;
    let full = f64::from(foliage.leaf_area_index) * crown_m2 / leaf.area_m2.max(1e-9);
    let leaves_each = if count > 0.0 { (full / count).max(1.0) } else { 0.0 };
    let leaf_mass = leaves_each * leaf.area_m2 * f64::from(foliage.areal_density_kg_m2);

    let trunk = &skeleton.segments[0];
    let anchor = f64::from(wood.anchorage) * young * area_moment(f64::from(trunk.start_radius_m))
        / f64::from(skeleton.height_m()).max(1e-3);
    drafts[0].bending = 1.0 / (1.0 / drafts[0].bending + 1.0 / anchor);

    let outboard = outboard_of(skeleton, &drafts, leaf_mass);
    let sway_hz = sway_frequency(skeleton, &drafts, &outboard, leaf_mass);
    let damping = 2.0 * f64::from(wood.damping) / (TAU * sway_hz);
    let half_air = 0.5 * AIR_DENSITY;
    let segments =
        skeleton.segments.iter().zip(&drafts).zip(&outboard).map(|((segment, draft), outboard)| {
            let (parent_pose, parent_start) =
                segment.parent.map_or((DQuat::IDENTITY, DVec3::ZERO), |parent| {
                    (drafts[parent as usize].pose, drafts[parent as usize].start)
                });
            let weight = DVec3::new(0.0, -f64::from(gravity_m_s2), 0.0);
            let preload =
                draft.pose.inverse() * -(outboard.moment - draft.start * outboard.mass).cross(weight);
            let diameter = f64::from(segment.start_radius_m + segment.end_radius_m);
            SegmentConstants {
                rest: (parent_pose.inverse() * draft.pose).normalize().as_quat().to_array(),
                offset: (parent_pose.inverse() * (draft.start - parent_start)).as_vec3().to_array(),
                length: single(draft.length),
                mass: single(draft.mass),
                first_moment: single(draft.first_moment),
                inertia_across: single(draft.inertia_across),
                inertia_along: single(draft.inertia_along),
                leaf_mass: single(leaf_mass),
                wood_drag: single(half_air * f64::from(wood.drag) * diameter * draft.length),
                leaf_drag: single(half_air * f64::from(foliage.drag) * leaves_each * leaf.area_m2),
                leaf_yield: single(1.0 / f64::from(foliage.yield_m_s)),
                preload: preload.as_vec3().to_array(),
                damping: single(damping),
                bending: single(draft.bending),
                twisting: single(draft.bending * 2.0 * SHEAR_SHARE),
                parent: NO_SEGMENT,
                first_child: NO_SEGMENT,
                next_sibling: NO_SEGMENT,
                tree: 0,
                padding: Default::default(),
            }
        });
    let facts = TreeFacts {
        crown_m2,
        leaves_each,
        leaf_m2: leaves_each * leaf.area_m2,
        wood_kg: drafts.iter().map(|draft| draft.mass).sum(),
        leaves_kg: leaf_mass * count,
        sway_hz,
    };
    (segments.collect(), facts)
}

/// A truncated cone of wood, and the joint at its lower end.
fn draft_of(segment: &Segment, parent: Option<(&Segment, &Draft)>, young: f64, density: f64) -> Draft {
    let start = segment.start_m.as_dvec3();
    let way = segment.end_m.as_dvec3() - start;
    let length = way.length();
    let axis = way / length;
    let (below, frame) = parent.map_or((DVec3::Y, DQuat::IDENTITY), |(_, draft)| (draft.axis, draft.pose));
    let (a, b) = (f64::from(segment.start_radius_m), f64::from(segment.end_radius_m));
    let per_area = density * PI * length;
    let fourth = per_area * (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b);
    let inertia_across =
        per_area * length * length * (a * a + 3.0 * a * b + 6.0 * b * b) / 30.0 + fourth / 20.0;
    let flexibility = |segment: &Segment, share: f64| {
        let (a, b) = (f64::from(segment.start_radius_m), f64::from(segment.end_radius_m));
        let radius = a + (b - a) * share;
        0.5 * f64::from(segment.length_m()) / (young * area_moment(radius))
    };
    let bending =
        1.0 / (flexibility(segment, 0.25) + parent.map_or(0.0, |(parent, _)| flexibility(parent, 0.75)));
    Draft {
        pose: (DQuat::from_rotation_arc(below, axis) * frame).normalize(),
        start,
        axis,
        length,
        mass: per_area * (a * a + a * b + b * b) / 3.0,
        first_moment: per_area * length * (a * a + 2.0 * a * b + 3.0 * b * b) / 12.0,
        inertia_across,
        inertia_along: (fourth / 10.0).max(LEAST_AXIAL * inertia_across),
        leaves: 0,
        bending,
    }
}

/// Second moment of area of a round section in m⁴.
fn area_moment(radius: f64) -> f64 {
    0.25 * PI * radius * radius * radius * radius
}

/// Ground area beneath the leaves, or beneath the twigs of a tree without leaves.
fn crown_area(skeleton: &Skeleton, leaf: LeafFacts) -> f64 {
    let mut places: Vec<_> = skeleton.attachments.iter().map(|at| at.at_m).collect();
    if places.is_empty() {
        places.extend(skeleton.segments.iter().map(|segment| segment.end_m));
    }
    let points = places.into_iter().map(|place| place.as_dvec3().xz()).collect();
    ground_m2(points, libm::sqrt(leaf.area_m2))
}

/// Mass and first moment, about the tree's origin, of every segment with all that it carries.
fn outboard_of(skeleton: &Skeleton, drafts: &[Draft], leaf_mass: f64) -> Vec<Outboard> {
    let mut outboard = vec![Outboard::default(); drafts.len()];
    for (index, draft) in drafts.iter().enumerate().rev() {
        let leaves = leaf_mass * f64::from(draft.leaves);
        let mass = draft.mass + leaves;
        outboard[index].mass += mass;
        outboard[index].moment +=
            draft.start * mass + draft.axis * (draft.first_moment + leaves * 0.5 * draft.length);
        if let Some(parent) = skeleton.segments[index].parent {
            let own = outboard[index];
            outboard[parent as usize].mass += own.mass;
            outboard[parent as usize].moment += own.moment;
        }
    }
    outboard
}

/// Rayleigh's estimate of the main sway's frequency in Hz.
fn sway_frequency(skeleton: &Skeleton, drafts: &[Draft], outboard: &[Outboard], leaf_mass: f64) -> f64 {
    // The estimate does not depend on how strong gravity is.
    let sideways = DVec3::X;
    // Rotation and displacement of every segment under its weight turned sideways.
    let mut turns = vec![DVec3::ZERO; drafts.len()];
    let mut shifts = vec![DVec3::ZERO; drafts.len()];
    let (mut work, mut inertia) = (0.0, 0.0);
    for (index, draft) in drafts.iter().enumerate() {
        let torque = (outboard[index].moment - draft.start * outboard[index].mass).cross(sideways);
        let (mut turn, mut shift) = (DVec3::ZERO, DVec3::ZERO);
        if let Some(parent) = skeleton.segments[index].parent {
            let parent = parent as usize;
            turn = turns[parent];
            shift = shifts[parent] + turn.cross(draft.start - drafts[parent].start);
        }
        turn += torque / draft.bending;
        let leaves = leaf_mass * f64::from(draft.leaves);
        let mass = draft.mass + leaves;
        let middle = (draft.first_moment + leaves * 0.5 * draft.length) / mass;
        let moved = shift + turn.cross(draft.axis * middle);
        work += mass * sideways.x * moved.x;
        inertia += mass * moved.length_squared();
        turns[index] = turn;
        shifts[index] = shift;
    }
    libm::sqrt(work / inertia) / TAU
}
