// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Segments from joints, and their thickness from the mesh.

use std::cmp::Ordering;

use glam::Vec3;

use super::GltfError;
use super::rig::Rig;
use super::skinned::Skinned;
use super::vertices::{Vertices, along};
use crate::tree::skeleton::MIN_LENGTH_M;
use crate::tree::{Segment, Skeleton};

/// Radius over length where no vertex gives it.
const SLENDER: f32 = 0.02;

/// The skeleton of a rig, without attachments, and the segment of every joint.
///
/// # Errors
/// [`GltfError::Length`] for a joint that lies where its segment ends.
pub(super) fn skeleton(rig: &Rig, skinned: &Skinned, file: &str) -> Result<(Skeleton, Vec<u16>), GltfError> {
    let vertices = Vertices::of(rig, skinned);
    let Course { trunk, is_mark, next } = Course::of(rig, &vertices);
    let mut skeleton = Skeleton::default();
    let mut segments: Vec<u16> = vec![0; rig.joints.len()];
    let mut untold = Vec::new();
    let trunk_first = std::iter::once(trunk).chain(rig.order.iter().copied().filter(|&index| index != trunk));
    for index in trunk_first {
        let joint = &rig.joints[index];
        let parent = joint.parent.map(|parent| segments[parent]);
        if is_mark[index] {
            segments[index] = parent.unwrap_or(0);
            continue;
        }
        let start_m = place(rig, index);
        let end_m = match (joint.extras.length_m, next[index]) {
            (Some(length_m), _) => start_m + along(rig, index) * length_m,
            (None, Some(next)) => place(rig, next),
            (None, None) => start_m + vertices.reach(rig, index),
        };
        let length_m = start_m.distance(end_m);
        if length_m.is_nan() || length_m < MIN_LENGTH_M {
            let (file, node, name) = (file.into(), joint.node, joint.name.clone());
            return Err(GltfError::Length { file, node, name, length_m });
        }
        let radii = joint.extras.radius_m.or_else(|| vertices.radii(index, start_m, end_m));
        if radii.is_none() {
            untold.push(index);
        }
        let [start_radius_m, end_radius_m] = radii.unwrap_or([SLENDER * length_m; 2]);
        let above = parent.map(|parent| skeleton.segments[usize::from(parent)]);
        let is_continued = joint.parent.is_some_and(|parent| next[parent] == Some(index));
        let order = above.map_or(0, |above| above.order + u32::from(!is_continued));
        let order = joint.extras.order.unwrap_or(order);
        // A skin has no more than 65536 joints.
        segments[index] = u16::try_from(skeleton.segments.len()).unwrap_or(u16::MAX);
        // Further roots are stems beside the trunk: they grow from its foot.
        let parent = parent.map(u32::from).or((index != trunk).then_some(0));
        skeleton.segments.push(Segment { parent, start_m, end_m, start_radius_m, end_radius_m, order });
    }
    // Where no vertex tells, wood is as thick as what goes on from it; otherwise as what it comes from.
    for &index in untold.iter().rev() {
        let of = |joint: usize| skeleton.segments[usize::from(segments[joint])];
        let goes_on = next[index].filter(|&next| !is_mark[next]).map(|next| of(next).start_radius_m);
        let radius_m = goes_on.or(rig.joints[index].parent.map(|parent| of(parent).end_radius_m));
        if let Some(radius_m) = radius_m {
            let segment = &mut skeleton.segments[usize::from(segments[index])];
            (segment.start_radius_m, segment.end_radius_m) = (radius_m, radius_m);
        }
    }
    Ok((skeleton, segments))
}

/// Order of segments.
struct Course {
    /// The root that is the trunk's.
    trunk: usize,
    /// Joints that only mark where another one's segment ends.
    is_mark: Vec<bool>,
    /// The joint at the end of each one's segment.
    next: Vec<Option<usize>>,
}

impl Course {
    fn of(rig: &Rig, vertices: &Vertices) -> Self {
        let all = 0..rig.joints.len();
        let children = rig.children();
        let is_mark: Vec<bool> = all
            .clone()
            .map(|index| {
                let joint = &rig.joints[index];
                let carries = !children[index].is_empty() || vertices.is_moved[index];
                !carries && joint.parent.is_some() && joint.extras.length_m.is_none()
            })
            .collect();
        let carried = carried(rig, &is_mark);
        let girths: Vec<f32> = all.clone().map(|joint| vertices.girth_m(rig, joint)).collect();
        // The thickest; of equals the one that carries most, and of those the first.
        let foremost = |candidates: &[usize]| {
            let is_before = |a: usize, b: usize| match girths[a].total_cmp(&girths[b]) {
                Ordering::Equal => carried[a] > carried[b],
                unequal => unequal == Ordering::Greater,
            };
            candidates.iter().copied().reduce(|best, other| if is_before(other, best) { other } else { best })
        };
        let roots: Vec<usize> = all.clone().filter(|&index| rig.joints[index].parent.is_none()).collect();
        // A child far below where the wood ends is a branch, even if it is the only one.
        let next = all.map(|index| {
            foremost(&children[index]).filter(|&child| {
                let length_m = place(rig, index).distance(place(rig, child));
                let is_short = length_m < 0.5 * vertices.reach(rig, index).length();
                is_mark[child] || length_m < MIN_LENGTH_M || !is_short
            })
        });
        let next = next.collect();
        // A skin has at least one joint, and nodes are free of cycles.
        Self { trunk: foremost(&roots).unwrap_or(0), is_mark, next }
    }
}

/// Place of a joint.
fn place(rig: &Rig, joint: usize) -> Vec3 {
    rig.joints[joint].world.w_axis.truncate().as_vec3()
}

/// Number of joints that each carries, itself included; those that only mark ends count nothing.
fn carried(rig: &Rig, is_mark: &[bool]) -> Vec<u32> {
    let mut carried: Vec<u32> = is_mark.iter().map(|is_mark| u32::from(!is_mark)).collect();
    for &joint in rig.order.iter().rev() {
        if let Some(parent) = rig.joints[joint].parent {
            carried[parent] += carried[joint];
        }
    }
    carried
}
