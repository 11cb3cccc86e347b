// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Root and tip of a blade, and how sure they are.
//!
//! Leaves are nearly symmetric: the axis about which the blade overlaps best with its mirror image has the root at
//! one end. A petiole says at which; without one a notch at the base and the midrib's strength vote.

use glam::Vec2;

use super::ridge::Ridges;
use crate::Mask;
use crate::math::{floor_i32, segment_distance};

/// Number of pixels that the overlap is measured with, at most.
const SAMPLES: usize = 6000;
/// Greatest angle between the best axis and the line from the petiole through the blade's centre, in degrees.
const LEAN: i32 = 35;

/// Weight of a line along an axis against the overlap of the blade with its mirror image.
const MIDRIB: f32 = 0.4;
/// Weight of the direction of lateral veins in the choice between base and tip.
const SLANT: f32 = 0.6;

/// The two ends of a midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends {
    /// Junction of petiole and blade.
    pub(crate) root: Vec2,
    /// The far end of the midrib.
    pub(crate) tip: Vec2,
    /// 0 (guessed) to 1 (known).
    pub(crate) confidence: f32,
}

/// Evidence for root and tip.
pub(crate) struct Evidence<'a> {
    pub(crate) blade: &'a Mask,
    /// √A in pixels.
    pub(crate) side: f32,
    /// Closed polygon around the blade.
    pub(crate) outline: &'a [Vec2],
    /// Apparent junction of a petiole and the blade, and its confidence.
    pub(crate) petiole: Option<(Vec2, f32)>,
    /// Lines on the blade, on the same grid, if there is a photo.
    pub(crate) ridges: Option<&'a Ridges>,
    /// Root that somebody pointed at.
    pub(crate) given_root: Option<Vec2>,
}

impl Evidence<'_> {
    /// Decides root and tip.
    pub(crate) fn decide(&self) -> Ends {
        let pixels = self.pixels();
        let centre = pixels.iter().sum::<Vec2>() / (pixels.len() as f32).max(1.0);
        if let Some((junction, sure)) = self.given_root.map(|root| (root, 1.0)).or(self.petiole) {
            let root = self.nearest_margin(junction);
            let toward = (centre - root).try_normalize().unwrap_or(Vec2::NEG_Y);
            let turned = |degrees: i32| Vec2::from_angle((degrees as f32).to_radians()).rotate(toward);
            let axis = self.best_axis(root, (-LEAN..=LEAN).map(turned), &pixels).unwrap_or(toward);
            let agreement =
                self.vote(root, axis, centre) - self.vote(self.far_end(root, axis), -axis, centre);
            let confidence = match self.given_root {
                Some(_) => 1.0,
                None => (sure + 0.25 * agreement).clamp(0.0, 0.98),
            };
            return Ends { root, tip: self.far_end(root, axis), confidence };
        }
        let all = (0..180).map(|degrees| Vec2::from_angle((degrees as f32).to_radians()));
        let axis = self.best_axis(centre, all, &pixels).unwrap_or(Vec2::Y);
        let ends = [-axis, axis].map(|direction| self.near_end(centre, direction));
        let lead = self.vote(ends[0], axis, centre) - self.vote(ends[1], -axis, centre);
        let (root, toward) = if lead >= 0.0 { (ends[0], axis) } else { (ends[1], -axis) };
        Ends { root, tip: self.far_end(root, toward), confidence: (0.35 + 0.6 * lead.abs()).min(0.9) }
    }

    /// The axis through a point about which the blade mirrors best and along which a line runs.
    fn best_axis(&self, on: Vec2, axes: impl Iterator<Item = Vec2>, pixels: &[Vec2]) -> Option<Vec2> {
        let strong = self.ridges.map_or(1.0, Ridges::strong);
        let score = |axis: Vec2| self.overlap(on, axis, pixels) + MIDRIB * self.midrib(on, axis, strong);
        let scored = axes.map(|axis| (score(axis), axis));
        scored.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, axis)| axis)
    }

    /// Mean strength of a line along an axis through the blade, against the blade's strong lines; 0 to 1.
    fn midrib(&self, on: Vec2, axis: Vec2, strong: f32) -> f32 {
        let Some(ridges) = self.ridges else { return 0.0 };
        let (mut sum, mut count) = (0.0, 0.0_f32);
        for step in -60..=60 {
            let p = on + axis * (0.02 * self.side * step as f32);
            if self.blade.contains(floor_i32(p.x), floor_i32(p.y)) {
                sum += (self.strongest_near(ridges, p, axis) / strong).min(1.0);
                count += 1.0;
            }
        }
        sum / count.max(1.0)
    }

    /// Strongest line at a point or a little beside an axis.
    fn strongest_near(&self, ridges: &Ridges, p: Vec2, axis: Vec2) -> f32 {
        let step = Vec2::new(-axis.y, axis.x) * (0.008 * self.side);
        (-3..=3).map(|k| ridges.strength.sample(p + step * k as f32)).fold(0.0, f32::max)
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
            self.blade.contains(floor_i32(mirrored.x), floor_i32(mirrored.y))
        });
        hits.count() as f32 / (pixels.len() as f32).max(1.0)
    }

    /// Point of the outline nearest to `p`.
    fn nearest_margin(&self, p: Vec2) -> Vec2 {
        let sides = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let foot = |(a, b): (&Vec2, &Vec2)| a.lerp(*b, segment_distance(p, *a, *b).1);
        sides.map(foot).min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
    }

    /// Point at which a ray from inside leaves the blade for good, drawn to anything that sticks out
    /// there, such as a petiole's stub.
    fn near_end(&self, from: Vec2, direction: Vec2) -> Vec2 {
        let mut last = from;
        let reach = (self.blade.width + self.blade.height) as f32;
        let mut travelled = 0.0;
        while travelled < reach {
            let p = from + direction * travelled;
            if self.blade.contains(floor_i32(p.x), floor_i32(p.y)) {
                last = p;
            }
            travelled += 0.5;
        }
        let near = 0.12 * self.side;
        let score = |p: &Vec2| (*p - last).dot(direction) - 0.7 * (*p - last).perp_dot(direction).abs();
        let stands_out = self.outline.iter().filter(|p| p.distance(last) < near && score(p) > 0.0);
        stands_out.max_by(|a, b| score(a).total_cmp(&score(b))).copied().unwrap_or(last)
    }

    /// The corner of the outline that lies farthest along an axis, those beside it counting less.
    fn far_end(&self, root: Vec2, axis: Vec2) -> Vec2 {
        let score = |p: &Vec2| (*p - root).dot(axis) - 0.6 * (*p - root).perp_dot(axis).abs();
        self.outline.iter().max_by(|a, b| score(a).total_cmp(&score(b))).copied().unwrap_or(root)
    }

    /// Likeness of an end to a base, about -1 to 1; `axis` points from it into the blade.
    fn vote(&self, end: Vec2, axis: Vec2, centre: Vec2) -> f32 {
        let shape = 0.4 * self.notch(end, axis) + 0.35 * self.stub(end, axis);
        let Some(ridges) = self.ridges else { return shape };
        // The midrib is stronger and wider at the base.
        let half = (centre - end).dot(axis).max(1.0);
        let strength = |from: f32, to: f32| -> f32 {
            let along = |step: i32| end + axis * (half * (from + (to - from) * step as f32 / 24.0));
            (0..24).map(|step| self.strongest_near(ridges, along(step), axis)).sum()
        };
        let (near, far) = (strength(0.15, 0.8), strength(1.2, 1.85));
        shape + 0.2 * (near - far) / (near + far).max(1e-6) + SLANT * self.slant(ridges, end, axis)
    }

    /// Depth of a notch at an end, 0 to 1: the margin on both sides of it lies farther out.
    fn notch(&self, end: Vec2, axis: Vec2) -> f32 {
        let out = |sign: f32| {
            let beside = self.outline.iter().filter(|p| {
                let across = sign * (**p - end).perp_dot(axis) / self.side;
                (0.03..0.45).contains(&across)
            });
            beside.map(|p| -(*p - end).dot(axis) / self.side).fold(0.0, f32::max)
        };
        (out(1.0).min(out(-1.0)) * 8.0).min(1.0)
    }

    /// Likeness of an end to a petiole's stub, 0 to 1: thin, and as thin further in.
    fn stub(&self, end: Vec2, axis: Vec2) -> f32 {
        let side = self.side;
        let across = Vec2::new(-axis.y, axis.x);
        let width = |depth: f32| {
            let count = (-24..=24).filter(|k| {
                let p = end + axis * (depth * side) + across * (0.005 * side * *k as f32);
                self.blade.contains(floor_i32(p.x), floor_i32(p.y))
            });
            0.005 * count.count() as f32
        };
        let (outer, inner) = ((width(0.012) + width(0.02)) / 2.0, (width(0.036) + width(0.044)) / 2.0);
        let thin = ((0.075 - inner) / 0.03).clamp(0.0, 1.0);
        let even = ((1.9 - inner / outer.max(0.005)) / 0.5).clamp(0.0, 1.0);
        thin * even
    }

    /// Share of lines that lead outward away from an end, as lateral veins do from the root; -1 to 1.
    fn slant(&self, ridges: &Ridges, end: Vec2, axis: Vec2) -> f32 {
        let width = ridges.strength.width;
        let (mut lead, mut all) = (0.0, 0.0);
        for (i, (strength, doubled)) in ridges.strength.values.iter().zip(&ridges.doubled).enumerate() {
            let p = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            let side = (p - end).perp_dot(axis);
            // Twice along × across is the sine of the doubled angle between line and axis.
            let turned = Vec2::new(axis.x * axis.x - axis.y * axis.y, 2.0 * axis.x * axis.y);
            let sine = -turned.perp_dot(*doubled) * side.signum();
            if side.abs() > 0.06 * self.side {
                lead += strength * strength * sine;
                all += strength * strength * sine.abs();
            }
        }
        if all > 0.0 { lead / all } else { 0.0 }
    }
}
