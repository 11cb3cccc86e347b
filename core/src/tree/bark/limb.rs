// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which segments share one skin.

use crate::tree::{Segment, Skeleton};

/// Cosine of the sharpest bend that one skin goes round.
const SHARPEST_BEND: f32 = -0.2;

/// Segments one after the other under one skin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Limb {
    /// The segment that the limb grows from; `None` for the trunk.
    pub(super) parent: Option<u32>,
    /// Its segments from the base to the tip, at least one.
    pub(super) segments: Vec<u32>,
}

/// The limbs of a skeleton, each after the one it grows from, without those that begin thinner than `thinnest_m` and
/// what grows on them.
pub(super) fn limbs(skeleton: &Skeleton, thinnest_m: f32) -> Vec<Limb> {
    let segments = &skeleton.segments;
    let next = continuations(segments);
    let mut has_skin = vec![false; segments.len()];
    let mut limbs = Vec::new();
    for (first, index) in segments.iter().zip(0u32..) {
        let is_base = first.parent.is_none_or(|parent| next[parent as usize] != Some(index));
        let is_held = first.parent.is_none_or(|parent| has_skin[parent as usize]);
        let is_thick = first.parent.is_none() || first.start_radius_m >= thinnest_m;
        if !(is_base && is_held && is_thick) {
            continue;
        }
        let along: Vec<u32> = std::iter::successors(Some(index), |&segment| next[segment as usize]).collect();
        along.iter().for_each(|&segment| has_skin[segment as usize] = true);
        limbs.push(Limb { parent: first.parent, segments: along });
    }
    limbs
}

/// For every segment the child that carries its skin on: the thickest of those that begin at its end.
fn continuations(segments: &[Segment]) -> Vec<Option<u32>> {
    let mut next: Vec<Option<u32>> = vec![None; segments.len()];
    for (child, index) in segments.iter().zip(0u32..) {
        let Some(parent) = child.parent else { continue };
        let wood = &segments[parent as usize];
        let is_at_end = child.start_m.distance(wood.end_m) <= 0.5 * wood.end_radius_m;
        let goes_on = child.direction().dot(wood.direction()) > SHARPEST_BEND;
        let rival = next[parent as usize].map(|rival| &segments[rival as usize]);
        let is_thicker = rival.is_none_or(|rival| child.start_radius_m > rival.start_radius_m);
        if is_at_end && goes_on && is_thicker {
            next[parent as usize] = Some(index);
        }
    }
    next
}
