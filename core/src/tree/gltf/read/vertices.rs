// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measurements of a segment from the vertices of its joint.

use glam::{DVec3, Vec3};

use super::rig::Rig;
use super::skinned::Skinned;

/// Share from which on a joint's vertex shows how thick its segment is.
const FIRM_SHARE: f32 = 0.45;
/// Thinnest segment in metres.
const MIN_RADIUS_M: f32 = 1e-5;
/// A joint's y axis in the world.
pub(super) fn along(rig: &Rig, joint: usize) -> Vec3 {
    rig.joints[joint].world.y_axis.truncate().normalize_or(DVec3::Y).as_vec3()
}

/// The vertices of every joint.
pub(super) struct Vertices {
    /// Places of the vertices that follow each joint.
    firm: Vec<Vec<Vec3>>,
    /// True if a joint moves any vertex.
    pub(super) is_moved: Vec<bool>,
}

impl Vertices {
    pub(super) fn of(rig: &Rig, skinned: &Skinned) -> Self {
        let mut firm = vec![Vec::new(); rig.joints.len()];
        let mut is_moved = vec![false; rig.joints.len()];
        let mesh = &skinned.mesh;
        for ((place, joints), weights) in mesh.positions_m.iter().zip(&mesh.joints).zip(&mesh.weights) {
            for (&joint, &weight) in joints.iter().zip(weights) {
                is_moved[usize::from(joint)] |= weight > 0.0;
                if weight >= FIRM_SHARE {
                    firm[usize::from(joint)].push(Vec3::from_array(*place));
                }
            }
        }
        Self { firm, is_moved }
    }

    /// About how thick what follows a joint is: median of the distances from the line to its middle.
    pub(super) fn girth_m(&self, rig: &Rig, joint: usize) -> f32 {
        let start_m = rig.joints[joint].world.w_axis.truncate().as_vec3();
        let offsets = || self.firm[joint].iter().map(|place| *place - start_m);
        let axis = offsets().sum::<Vec3>().normalize_or(along(rig, joint));
        let mut distances: Vec<f32> =
            offsets().map(|offset| offset.reject_from_normalized(axis).length()).collect();
        distances.sort_by(f32::total_cmp);
        distances.get(distances.len() / 2).copied().unwrap_or(0.0)
    }

    /// From a joint at a tip to the end of what follows it.
    pub(super) fn reach(&self, rig: &Rig, joint: usize) -> Vec3 {
        let start_m = rig.joints[joint].world.w_axis.truncate().as_vec3();
        let offsets = || self.firm[joint].iter().map(|place| *place - start_m);
        let sum: Vec3 = offsets().sum();
        let direction = sum.normalize_or(along(rig, joint));
        direction * offsets().map(|offset| offset.dot(direction)).fold(0.0, f32::max)
    }

    /// Radii at both ends of a segment: medians of the distances from its axis. None if no vertex follows the joint.
    pub(super) fn radii(&self, joint: usize, start_m: Vec3, end_m: Vec3) -> Option<[f32; 2]> {
        let axis = end_m - start_m;
        let within = |low: f32, high: f32| {
            let mut distances: Vec<f32> = Vec::new();
            for place in &self.firm[joint] {
                let share = (*place - start_m).dot(axis) / axis.length_squared();
                if (low..=high).contains(&share) {
                    distances.push(place.distance(start_m + axis * share));
                }
            }
            distances.sort_by(f32::total_cmp);
            distances.get(distances.len() / 2).copied()
        };
        let (lower, upper) = (within(-0.1, 0.35), within(0.65, 1.1));
        let any = || within(f32::MIN, f32::MAX);
        let start_m = lower.or(upper).or_else(any)?.max(MIN_RADIUS_M);
        Some([start_m, upper.map_or(start_m, |radius_m| radius_m.max(MIN_RADIUS_M))])
    }
}
