// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Skeletons for tests.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};

use super::{Attachment, AttachmentKind, Segment, Skeleton};
use crate::arith::rng::{random, unit_float};

/// A tree of `depth` orders with leaves and fruit on its twigs, another for every seed: bent limbs, forks, side branches
/// in the middle of segments, on the axis and on the bark.
pub(crate) fn tree(seed: u32, depth: u32) -> Skeleton {
    let mut skeleton = Skeleton::default();
    limb(&mut skeleton, seed, None, Vec3::ZERO, Vec3::Y, [1.0, 0.2], depth);
    let twigs = skeleton.segments.iter().zip(0u32..).filter(|(segment, _)| segment.order + 1 == depth);
    for (segment, index) in twigs {
        let direction = segment.direction().any_orthonormal_vector();
        let kind = if index % 5 == 0 { AttachmentKind::Fruit } else { AttachmentKind::Leaf };
        let at_m = segment.end_m + direction * segment.end_radius_m;
        let normal = segment.direction().reject_from(direction).normalize();
        skeleton.attachments.push(Attachment { segment: index, kind, at_m, direction, normal });
    }
    skeleton.validate().expect("a tree that can be");
    skeleton
}

fn limb(
    skeleton: &mut Skeleton,
    seed: u32,
    parent: Option<u32>,
    start_m: Vec3,
    direction: Vec3,
    [length_m, radius_m]: [f32; 2],
    depth: u32,
) {
    let (mut parent, mut start_m, mut direction) = (parent, start_m, direction);
    let order = parent.map_or(0, |parent| skeleton.segments[parent as usize].order + 1);
    for step in 0u8..5 {
        let index = u32::try_from(skeleton.segments.len()).expect("few");
        let draw = random([seed, 7], index, 0).map(unit_float);
        let taper = 1.0 - 0.15 * f32::from(step);
        let end_m = start_m + direction * length_m * (0.6 + 0.8 * draw[0]);
        let (start_radius_m, end_radius_m) = (radius_m * taper, radius_m * (taper - 0.12));
        skeleton.segments.push(Segment { parent, start_m, end_m, start_radius_m, end_radius_m, order });
        let aside = Quat::from_axis_angle(direction, draw[1] * TAU) * direction.any_orthonormal_vector();
        if depth > 1 && step > 0 {
            let on_bark = if step == 2 { start_radius_m } else { 0.0 };
            let base = start_m.lerp(end_m, draw[2]) + aside * on_bark;
            let base = if step == 3 { end_m } else { base };
            let away = (aside + direction * 0.7).normalize();
            limb(skeleton, seed, Some(index), base, away, [0.5 * length_m, 0.4 * radius_m], depth - 1);
        }
        direction = (direction + aside * 0.5 * draw[3]).normalize();
        (parent, start_m) = (Some(index), end_m);
    }
}
