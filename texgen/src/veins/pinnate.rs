// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A rib and its laterals.

use glam::Vec2;

use super::{Order, Plan, Vein};
use crate::contour::Rib;
use crate::math::{point_along, quadratic};
use crate::rng::Rng;

/// A rib with the laterals on each side, from the base outward.
pub(super) struct Branches {
    /// The rib.
    pub(super) rib: Vein,
    /// Laterals on the right.
    pub(super) right: Vec<Vein>,
    /// Laterals on the left.
    pub(super) left: Vec<Vein>,
}

/// Radius of a rib just before its tip.
const TIP_RADIUS: f32 = 0.0035;

/// Draws a rib and leads a lateral to each of its targets.
pub(super) fn branch(rib: &Rib, plan: &Plan, midrib: bool, rng: &mut Rng) -> Branches {
    let path = rib_path(rib);
    let mut side = |targets: &[Vec2]| -> Vec<(f32, Vein)> {
        targets.iter().filter_map(|&target| lateral(&path, target, plan, rng)).collect()
    };
    let (right, left) = (side(&rib.right), side(&rib.left));
    let joins: Vec<(f32, f32)> = right
        .iter()
        .chain(&left)
        .map(|(at, vein)| (*at, vein.radii.first().copied().unwrap_or(0.0)))
        .collect();
    let last = path.len().saturating_sub(1).max(1) as f32;
    // A midrib also carries the fine veins that are not drawn.
    let own = if midrib { 0.011_f32 } else { 0.0095 };
    let radii = (0..path.len())
        .map(|i| {
            let here = i as f32 / last;
            // Murray's law: cubes of the radii add up where veins join.
            let beyond: f32 = joins.iter().filter(|(at, _)| *at >= here).map(|(_, r)| r.powi(3)).sum();
            (TIP_RADIUS.powi(3) + beyond + own.powi(3) * (1.0 - here)).cbrt()
        })
        .collect();
    let strip = |side: Vec<(f32, Vein)>| side.into_iter().map(|(_, vein)| vein).collect();
    Branches {
        rib: Vein { points: path, radii, order: Order::Primary },
        right: strip(right),
        left: strip(left),
    }
}

/// Path of a rib: it leaves in its own direction and bends to its tip.
fn rib_path(rib: &Rib) -> Vec<Vec2> {
    const STEPS: u16 = 40;
    let base = Vec2::new(0.0, -1.0);
    let control = base + rib.start * base.distance(rib.tip) * 0.5;
    (0..=STEPS).map(|i| quadratic(base, control, rib.tip, f32::from(i) / f32::from(STEPS))).collect()
}

/// Lateral to a target, with the fraction of the rib where it starts; none to targets below the reach of the rib.
fn lateral(path: &[Vec2], target: Vec2, plan: &Plan, rng: &mut Rng) -> Option<(f32, Vein)> {
    let angle = (plan.divergence_deg + 4.0 * rng.bell()).to_radians();
    const STATIONS: u16 = 64;
    let off_angle = |fraction: f32| {
        let (from, along) = point_along(path, fraction);
        ((target - from).angle_to(along).abs() - angle).abs()
    };
    let start = (1..STATIONS)
        .map(|i| f32::from(i) / f32::from(STATIONS) * 0.96)
        .map(|fraction| (fraction, off_angle(fraction)))
        .reduce(|best, next| if next.1 < best.1 { next } else { best })
        .filter(|&(fraction, error)| fraction > 0.05 || error < 0.25)?
        .0;
    let (from, along) = point_along(path, start);
    let reach = from.distance(target);
    let straight = (target - from).normalize_or(along);
    // The lateral leaves at a wider angle than its chord and bows towards the rib's tip.
    let away = (straight - along * plan.bow).normalize_or(straight);
    let control = from + away * reach * 0.5;
    const STEPS: u16 = 20;
    let points = (0..=STEPS).map(|i| quadratic(from, control, target, f32::from(i) / f32::from(STEPS)));
    let radius = plan.lateral_radius * reach.clamp(0.1, 1.6).powf(0.6);
    Some((start, Vein::tapering(points.collect(), radius, radius * 0.3, Order::Secondary)))
}
