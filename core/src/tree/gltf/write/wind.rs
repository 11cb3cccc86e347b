// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Weights for shaders that bend a tree without joints.

use glam::Vec3;

use crate::arith::rng::{random, unit_float};
use crate::tree::{BarkMesh, Skeleton};

/// Shares of the trunk's radius from which on wood flutters, and where it does so fully.
const FLUTTER: [f32; 2] = [0.1, 0.01];
/// Stream of the phases.
const PHASE: u32 = 1;

/// Numbers that are the same for a whole segment.
#[derive(Clone, Copy)]
struct Course {
    /// Way from the trunk to the lower end in metres.
    from_trunk_m: f32,
    /// Phase of the branch, from 0 to 1.
    phase: f32,
}

/// Weights of every vertex, as [`super::super::WIND_WEIGHT`] has them.
pub(super) fn weights(skeleton: &Skeleton, mesh: &BarkMesh) -> Vec<[f32; 4]> {
    let courses = courses(skeleton);
    let height_m = skeleton.height_m().max(f32::MIN_POSITIVE);
    let ends = skeleton.segments.iter().zip(&courses).filter(|(segment, _)| segment.order > 0);
    let longest_m =
        ends.map(|(segment, course)| course.from_trunk_m + segment.length_m()).fold(0.0, f32::max);
    let trunk_m = skeleton.segments.first().map_or(1.0, |trunk| trunk.start_radius_m);
    let vertex =
        |index: usize| {
            let place = Vec3::from_array(mesh.positions_m[index]);
            let height = (place.y / height_m).clamp(0.0, 1.0);
            let (mut phase, mut bend, mut flutter) = (0.0, 0.0, 0.0);
            // The strongest joint decides about the phase: half-way between two branches is neither.
            let strongest = (0..4).fold(0, |best, slot| {
                if mesh.weights[index][slot] > mesh.weights[index][best] { slot } else { best }
            });
            for slot in 0..4 {
                let weight = mesh.weights[index][slot];
                let joint = usize::from(mesh.joints[index][slot]);
                let (segment, course) = (&skeleton.segments[joint], courses[joint]);
                let along_m =
                    (place - segment.start_m).dot(segment.direction()).clamp(0.0, segment.length_m());
                let share = along_m / segment.length_m();
                let radius_m =
                    segment.start_radius_m + (segment.end_radius_m - segment.start_radius_m) * share;
                let way_m = if segment.order > 0 { course.from_trunk_m + along_m } else { 0.0 };
                let thin = (FLUTTER[0] - radius_m / trunk_m) / (FLUTTER[0] - FLUTTER[1]);
                bend += weight * way_m / longest_m.max(f32::MIN_POSITIVE);
                flutter += weight * thin.clamp(0.0, 1.0);
                if slot == strongest {
                    phase = course.phase;
                }
            }
            [height * height, phase, bend, flutter].map(|value: f32| value.clamp(0.0, 1.0))
        };
    (0..mesh.positions_m.len()).map(vertex).collect()
}

/// Ways and phases of all segments.
fn courses(skeleton: &Skeleton) -> Vec<Course> {
    let mut courses: Vec<Course> = Vec::with_capacity(skeleton.segments.len());
    for (segment, index) in skeleton.segments.iter().zip(0u32..) {
        let above = segment.parent.map(|parent| (&skeleton.segments[parent as usize], parent));
        let course = match above {
            Some((parent, parent_index)) if segment.order > 0 && parent.order > 0 => {
                let course = courses[parent_index as usize];
                let along_m = (segment.start_m - parent.start_m).dot(parent.direction());
                let from_trunk_m = course.from_trunk_m + along_m.clamp(0.0, parent.length_m());
                Course { from_trunk_m, phase: course.phase }
            }
            _ if segment.order > 0 => {
                Course { from_trunk_m: 0.0, phase: unit_float(random([0; 2], index, PHASE)[0]) }
            }
            _ => Course { from_trunk_m: 0.0, phase: 0.0 },
        };
        courses.push(course);
    }
    courses
}
