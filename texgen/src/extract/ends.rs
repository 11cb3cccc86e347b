// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Root and tip of a blade, and how sure they are.
//!
//! Leaves are nearly symmetric: the axis about which the blade overlaps best with its mirror image has the root at
//! one end. A petiole says at which; without one a notch at the base and the midrib's strength vote.

use glam::Vec2;

use super::petiole::Petiole;
use crate::Mask;
use crate::field::Field;

/// Number of pixels that the overlap is measured with, at most.
const SAMPLES: usize = 6000;
/// Greatest angle between the best axis and the line from the petiole through the blade's centre, in degrees.
const LEAN: i32 = 35;

/// The two ends of a midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends {
    /// Where the petiole meets the blade.
    pub(crate) root: Vec2,
    /// The far end of the midrib.
    pub(crate) tip: Vec2,
    /// 0 (guessed) to 1 (known).
    pub(crate) confidence: f32,
}

/// What root and tip are judged by.
pub(crate) struct Evidence<'a> {
    pub(crate) blade: &'a Mask,
    /// Closed polygon around the blade.
    pub(crate) outline: &'a [Vec2],
    pub(crate) petiole: Option<&'a Petiole>,
    /// Strength of lines as large as the blade's mask, if there is a photo.
    pub(crate) ridges: Option<&'a Field>,
    /// Root that somebody pointed at.
    pub(crate) given_root: Option<Vec2>,
}

impl Evidence<'_> {
    /// Decides root and tip.
    pub(crate) fn decide(&self) -> Ends {
        let pixels = self.pixels();
        let centre = pixels.iter().sum::<Vec2>() / (pixels.len() as f32).max(1.0);
        let known = self.given_root.map(|root| (root, 1.0));
        if let Some((junction, sure)) = known.or_else(|| self.petiole.map(|p| (p.junction, p.confidence))) {
            let root = self.nearest_margin(junction);
            let toward = (centre - root).try_normalize().unwrap_or(Vec2::NEG_Y);
            let axis = (-LEAN..=LEAN)
                .map(|degrees| Vec2::from_angle((degrees as f32).to_radians()).rotate(toward))
                .max_by(|a, b| self.overlap(root, *a, &pixels).total_cmp(&self.overlap(root, *b, &pixels)))
                .unwrap_or(toward);
            let vote = self.vote(root, axis, centre);
            let confidence =
                if known.is_some() { 1.0 } else { (sure + 0.1 * vote.signum()).clamp(0.0, 0.98) };
            return Ends { root, tip: self.far_end(root, axis), confidence };
        }
        let axis = (0..180)
            .map(|degrees| Vec2::from_angle((degrees as f32).to_radians()))
            .max_by(|a, b| self.overlap(centre, *a, &pixels).total_cmp(&self.overlap(centre, *b, &pixels)))
            .unwrap_or(Vec2::Y);
        let ends = [axis, -axis].map(|direction| self.near_end(centre, direction));
        let votes = [self.vote(ends[0], -axis, centre), self.vote(ends[1], axis, centre)];
        let (root, toward) = if votes[0] >= votes[1] { (ends[0], -axis) } else { (ends[1], axis) };
        let lead = (votes[0] - votes[1]).abs();
        Ends { root, tip: self.far_end(root, toward), confidence: (0.3 + 0.9 * lead).min(0.85) }
    }

    /// Centres of some of the blade's pixels, evenly taken.
    fn pixels(&self) -> Vec<Vec2> {
        let step = (self.blade.area() / SAMPLES).max(1);
        let width = self.blade.width as usize;
        let inside = (0..self.blade.inside.len()).filter(|i| self.blade.inside[*i]);
        inside.step_by(step).map(|i| Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5)).collect()
    }

    /// Share of the pixels whose mirror image about a line lies in the blade.
    fn overlap(&self, on: Vec2, axis: Vec2, pixels: &[Vec2]) -> f32 {
        let hits = pixels.iter().filter(|p| {
            let from = **p - on;
            let mirrored = on + axis * (2.0 * from.dot(axis)) - from;
            self.blade.contains(crate::math::floor_i32(mirrored.x), crate::math::floor_i32(mirrored.y))
        });
        hits.count() as f32 / (pixels.len() as f32).max(1.0)
    }

    /// √A in pixels.
    fn side(&self) -> f32 {
        (self.blade.area() as f32).sqrt()
    }

    /// Point of the outline nearest to `p`.
    fn nearest_margin(&self, p: Vec2) -> Vec2 {
        let sides = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let foot = |(a, b): (&Vec2, &Vec2)| a.lerp(*b, crate::math::segment_distance(p, *a, *b).1);
        sides.map(foot).min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
    }

    /// Where a ray from inside leaves the blade for good, drawn to a point of the margin that sticks out nearby.
    fn near_end(&self, from: Vec2, direction: Vec2) -> Vec2 {
        let mut last = from;
        let reach = (self.blade.width + self.blade.height) as f32;
        let mut travelled = 0.0;
        while travelled < reach {
            let p = from + direction * travelled;
            if self.blade.contains(crate::math::floor_i32(p.x), crate::math::floor_i32(p.y)) {
                last = p;
            }
            travelled += 0.5;
        }
        let near = 0.05 * self.side();
        let score = |p: &Vec2| (*p - last).dot(direction) - (*p - last).perp_dot(direction).abs();
        let stands_out = self.outline.iter().filter(|p| p.distance(last) < near);
        stands_out.max_by(|a, b| score(a).total_cmp(&score(b))).copied().unwrap_or(last)
    }

    /// The corner of the outline that lies farthest along an axis, those beside it counting less.
    fn far_end(&self, root: Vec2, axis: Vec2) -> Vec2 {
        let score = |p: &Vec2| (*p - root).dot(axis) - 0.6 * (*p - root).perp_dot(axis).abs();
        self.outline.iter().max_by(|a, b| score(a).total_cmp(&score(b))).copied().unwrap_or(root)
    }

    /// How much an end looks like a base, about -1 to 1; `axis` points from it into the blade.
    fn vote(&self, end: Vec2, axis: Vec2, centre: Vec2) -> f32 {
        let side = self.side();
        // A notch: the margin to the left and to the right lies farther out than the end itself.
        let out = |sign: f32| {
            let beside = self.outline.iter().filter(|p| {
                let across = sign * (**p - end).perp_dot(axis) / side;
                (0.03..0.45).contains(&across)
            });
            beside.map(|p| -(*p - end).dot(axis) / side).fold(0.0, f32::max)
        };
        let notch = (out(1.0).min(out(-1.0)) * 8.0).min(1.0);
        let Some(ridges) = self.ridges else { return notch };
        // The midrib is strongest and widest at the base.
        let half = (centre - end).dot(axis).max(1.0);
        let strength = |from: f32, to: f32| {
            let steps = 24;
            let across = Vec2::new(-axis.y, axis.x);
            let total: f32 = (0..steps)
                .map(|step| {
                    let along = half * (from + (to - from) * step as f32 / steps as f32);
                    let best = (-4..=4)
                        .map(|k| ridges.sample(end + axis * along + across * (0.01 * side * k as f32)));
                    best.fold(0.0, f32::max)
                })
                .sum();
            total / steps as f32
        };
        let (near, far) = (strength(0.15, 0.8), strength(1.2, 1.85));
        notch + (near - far) / (near + far).max(1e-6)
    }
}
