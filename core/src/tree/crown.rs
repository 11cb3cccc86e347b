// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves and fruit on the twigs.
//!
//! A full crown has as many leaves as its leaf area index, the ground beneath it and the area of a leaf make it. If
//! fewer are asked for, every twig has its share of them, so the crown keeps its shape. Which segments bear leaves is
//! what the grammar says; wood that still grows in length bears leaves as well, the fewer the further it has come, so
//! that a young tree is green before its twigs are born.

use glam::{DVec2, DVec3};

use super::grammar::{Draws, Phyllotaxis, Settings};
use super::growth::Grown;
use super::skeleton::{Attachment, AttachmentKind};
use super::turtle::{Shoot, rotated};

/// Step number of the draws for leaves, which no step of a derivation has.
const LEAF_DRAWS: u32 = 1 << 16;
/// Step number of the draws for fruit.
const FRUIT_DRAWS: u32 = LEAF_DRAWS + 1;
/// Golden angle in degrees.
const GOLDEN_DEG: f64 = 137.507_764;
/// Part of a twig at its base without leaves.
const BARE_BASE: f64 = 0.1;
/// Largest deviation of the angle between twig and leaf, in degrees.
const SPREAD_DEG: f64 = 15.0;
/// Weight of the vertical in a leaf's direction, relative to the direction in which it grows.
const DROOP: f64 = 0.3;
/// Weight of the sky in the direction of a leaf's upper side, relative to the twig's end.
const SKYWARD: f64 = 1.5;
/// Fewest leaves of a seedling.
const FEWEST: f64 = 2.0;
/// Growth at which fruit are ripe enough to be there.
const FRUIT_GROWTH: f64 = 0.6;

/// Number of leaves of the full crown: leaf area index times the ground beneath it per area of a leaf.
pub(crate) fn full_count(
    grown: &[Grown],
    shoots: &[Shoot],
    settings: &Settings,
    leaf_area_index: f64,
) -> f64 {
    if !bears_leaves(shoots) {
        return 0.0;
    }
    let (mut points, mut twigs_m): (Vec<DVec2>, f64) = (Vec::new(), 0.0);
    for segment in grown.iter().filter(|segment| leafiness(segment, shoots) > 0.0) {
        points.push(DVec2::new(segment.start_m.x, segment.start_m.z));
        points.push(DVec2::new(segment.end_m.x, segment.end_m.z));
        twigs_m += segment.length_m;
    }
    // The leaves of a seedling are no longer than itself.
    let reach_m = settings.leaf_area_m2.sqrt().min(twigs_m);
    (leaf_area_index * ground_m2(points, reach_m) / settings.leaf_area_m2).round().max(FEWEST)
}

/// Returns true if there will ever be leaves.
fn bears_leaves(shoots: &[Shoot]) -> bool {
    shoots.iter().any(|shoot| shoot.leaves > 0.0)
}

/// Leaves for a segment compared with others.
fn leafiness(segment: &Grown, shoots: &[Shoot]) -> f64 {
    let young = 1.0 - segment.growth;
    let cube = young * young * young;
    shoots[segment.shoot].leaves.max(cube * cube) * segment.length_m
}

/// Attachments of a tree: at most `most` leaves, and at most so many fruit.
pub(crate) fn attachments(
    grown: &[Grown],
    shoots: &[Shoot],
    settings: &Settings,
    full_count: f64,
    most: u32,
    draws: impl Fn(u32, u32) -> Draws,
) -> Vec<Attachment> {
    let mut attachments = Vec::new();
    if bears_leaves(shoots) {
        let weights = grown.iter().map(|segment| leafiness(segment, shoots)).collect::<Vec<_>>();
        let counts = shares(&weights, full_count.min(f64::from(most)));
        for ((index, segment), count) in (0u32..).zip(grown).zip(counts) {
            let mut draws = draws(LEAF_DRAWS, index);
            let phase_deg = match settings.phyllotaxis {
                Phyllotaxis::Distichous => 0.0,
                _ => 360.0 * draws.unit(),
            };
            for leaf in 0..count {
                let along = BARE_BASE + (1.0 - BARE_BASE) * (f64::from(leaf) + 0.5) / f64::from(count);
                let around_deg = phase_deg + azimuth_deg(settings.phyllotaxis, leaf);
                let angle_deg = settings.leaf_angle_deg + SPREAD_DEG * (2.0 * draws.unit() - 1.0);
                let place = Place { along, around_deg, angle_deg, droop: DROOP };
                attachments.push(place.attachment(index, segment, AttachmentKind::Leaf));
            }
        }
    }
    let fruit =
        |segment: &Grown| if segment.growth >= FRUIT_GROWTH { shoots[segment.shoot].fruit } else { 0.0 };
    let weights = grown.iter().map(fruit).collect::<Vec<_>>();
    let counts = shares(&weights, weights.iter().sum::<f64>().min(f64::from(most)));
    for ((index, segment), count) in (0u32..).zip(grown).zip(counts) {
        let mut draws = draws(FRUIT_DRAWS, index);
        for one in 0..count {
            let place = Place {
                along: 1.0 - 0.3 * draws.unit(),
                around_deg: GOLDEN_DEG * f64::from(one) + 360.0 * draws.unit(),
                angle_deg: 40.0 + 60.0 * draws.unit(),
                droop: 1.5,
            };
            attachments.push(place.attachment(index, segment, AttachmentKind::Fruit));
        }
    }
    attachments
}

/// Angle of a leaf about its twig.
fn azimuth_deg(phyllotaxis: Phyllotaxis, leaf: u32) -> f64 {
    match phyllotaxis {
        Phyllotaxis::Alternate => GOLDEN_DEG * f64::from(leaf),
        Phyllotaxis::Opposite => 90.0 * f64::from(leaf / 2) + 180.0 * f64::from(leaf % 2),
        Phyllotaxis::Distichous => 180.0 * f64::from(leaf % 2),
    }
}

/// Whole numbers in proportion to `weights` with the sum `total`, which is below 2^32. Each is at most one off.
fn shares(weights: &[f64], total: f64) -> Vec<u32> {
    let sum: f64 = weights.iter().sum();
    let (mut passed, mut given) = (0.0, 0);
    weights
        .iter()
        .map(|weight| {
            passed += weight;
            // The last sum equals the first, added up in the same order, so nothing is left over.
            let due = if sum > 0.0 { (total.round() * (passed / sum)).round() } else { 0.0 };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to total")]
            let due = due as u32;
            let share = due - given;
            given = due;
            share
        })
        .collect()
}

/// Place and orientation of a leaf or fruit on a segment.
struct Place {
    /// 0 at the lower end, 1 at the upper one.
    along: f64,
    /// About the segment, from the level direction to the left.
    around_deg: f64,
    /// Between segment and leaf.
    angle_deg: f64,
    /// Weight compared with 1, the pull of growth.
    droop: f64,
}

impl Place {
    fn attachment(&self, index: u32, segment: &Grown, kind: AttachmentKind) -> Attachment {
        let axis = (segment.end_m - segment.start_m).normalize();
        let level = DVec3::Y.cross(axis).try_normalize().unwrap_or(DVec3::NEG_X);
        let outward = rotated(level, axis, self.around_deg.to_radians());
        let radius_m = segment.start_radius_m + (segment.end_radius_m - segment.start_radius_m) * self.along;
        let at_m = segment.start_m + (segment.end_m - segment.start_m) * self.along + outward * radius_m;
        let (sin, cos) = libm::sincos(self.angle_deg.to_radians());
        let direction = axis * cos + outward * sin;
        let direction = (direction + DVec3::NEG_Y * self.droop).try_normalize().unwrap_or(direction);
        let facing = axis + DVec3::Y * SKYWARD;
        let normal = (facing - direction * facing.dot(direction)).try_normalize();
        let normal = normal.unwrap_or_else(|| direction.any_orthonormal_vector());
        Attachment {
            segment: index,
            kind,
            at_m: at_m.as_vec3(),
            direction: direction.as_vec3().normalize(),
            normal: normal.as_vec3().normalize(),
        }
    }
}

/// Ground in m² beneath leaves that reach so far from the points, of which there is at least one.
pub(super) fn ground_m2(points: Vec<DVec2>, reach_m: f64) -> f64 {
    let (area, edge) = hull(points);
    area + edge * reach_m + std::f64::consts::PI * reach_m * reach_m
}

/// Area and length of the edge of the convex hull of at least one point.
fn hull(mut points: Vec<DVec2>) -> (f64, f64) {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
    let mut ring: Vec<DVec2> = Vec::new();
    for pass in 0..2 {
        let floor = ring.len() + 1;
        for &point in &points {
            while ring.len() > floor && turn(ring[ring.len() - 2], ring[ring.len() - 1], point) <= 0.0 {
                ring.pop();
            }
            ring.push(point);
        }
        if pass == 0 {
            points.reverse();
        }
        ring.pop();
    }
    let next = |index: usize| ring[(index + 1) % ring.len()];
    let area: f64 = (0..ring.len()).map(|index| ring[index].perp_dot(next(index))).sum();
    let edge: f64 = (0..ring.len()).map(|index| ring[index].distance(next(index))).sum();
    (area / 2.0, edge)
}
