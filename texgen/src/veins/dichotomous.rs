// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The forking veins of a fan: each splits in two whenever there is room, none ever meet again.

use glam::Vec2;

use super::{Order, Vein};
use crate::contour::Outline;
use crate::math::{lerp, polar};
use crate::rng::Rng;

/// Distance between neighbouring veins that makes them fork.
const SPACING: f32 = 0.085;
/// Where all veins begin.
const BASE: Vec2 = Vec2::new(0.0, -1.0);

/// Widest bearing on either side at a radius, so that the outer veins follow the flanks.
struct Flanks {
    right: Vec<(f32, f32)>,
    left: Vec<(f32, f32)>,
}

impl Flanks {
    fn new(blade: &[Vec2]) -> Self {
        let flank = |points: &mut dyn Iterator<Item = Vec2>| {
            let mut out: Vec<(f32, f32)> = Vec::new();
            for p in points {
                let radius = p.distance(BASE);
                // The flank ends where the outer edge turns back inward.
                if out.last().is_some_and(|last| radius <= last.0) {
                    break;
                }
                if radius > 0.02 {
                    out.push((radius, (p.x.abs()).atan2(p.y - BASE.y).to_degrees()));
                }
            }
            out
        };
        Self {
            right: flank(&mut blade.iter().copied()),
            left: flank(&mut blade.iter().skip(1).rev().copied()),
        }
    }

    /// Bearing at a radius of the vein that lies a share of the way (-1 left flank, 1 right flank).
    fn bearing(&self, share: f32, radius: f32) -> f32 {
        let table = if share < 0.0 { &self.left } else { &self.right };
        let above = table.iter().position(|(r, _)| *r >= radius);
        let widest = match above {
            Some(0) => table[0].1,
            Some(i) => {
                let (low, high) = (table[i - 1], table[i]);
                lerp(low.1, high.1, (radius - low.0) / (high.0 - low.0))
            }
            None => table.last().map_or(60.0, |last| last.1),
        };
        share * widest * 0.97
    }
}

/// A vein that still grows.
struct Bud {
    share: f32,
    /// Width of the band that it feeds, in shares.
    band: f32,
    radius: f32,
    points: Vec<Vec2>,
}

/// Grows the fan.
pub(super) fn grow(outline: &Outline, rng: &mut Rng) -> Vec<Vein> {
    let flanks = Flanks::new(&outline.blade);
    let edge = EdgeRadius::new(&outline.blade);
    let mut veins = Vec::new();
    let mut buds: Vec<Bud> = [-0.75, -0.25, 0.25, 0.75]
        .iter()
        .map(|&share| Bud { share, band: 0.5, radius: 0.0, points: vec![BASE] })
        .collect();
    while let Some(mut bud) = buds.pop() {
        const STEP: f32 = 0.03;
        // Daughters part gently from the middle of their mother's band.
        let mut offset = if bud.points.len() > 1 { -0.5 } else { 0.0 };
        let side = if bud.band > 0.0 { 1.0 } else { -1.0 };
        let band = bud.band.abs();
        let fork_width = SPACING * rng.range(1.5, 2.3);
        loop {
            bud.radius += STEP;
            let share = bud.share + offset * side * band;
            offset *= 0.8;
            let bearing = flanks.bearing(share, bud.radius);
            let at = BASE + polar(bearing, bud.radius);
            if bud.radius > edge.at(bearing) * 0.985 || bud.radius > 3.0 {
                break;
            }
            bud.points.push(at);
            let width = band * flanks.bearing(1.0, bud.radius).to_radians() * bud.radius;
            if width > fork_width && bud.radius > 0.12 {
                for daughter in [-1.0_f32, 1.0] {
                    buds.push(Bud {
                        share: bud.share + 0.25 * daughter * band,
                        band: daughter * band * 0.5,
                        radius: bud.radius,
                        points: vec![bud.points[bud.points.len().saturating_sub(2)], at],
                    });
                }
                break;
            }
        }
        let radius = (0.006 * (band / 0.5).cbrt()).max(0.0028);
        if bud.points.len() > 1 {
            let order = if band > 0.2 { Order::Secondary } else { Order::Tertiary };
            veins.push(Vein::tapering(bud.points, radius, radius * 0.85, order));
        }
    }
    veins
}

/// Radius of the outer edge by bearing.
struct EdgeRadius(Vec<f32>);

impl EdgeRadius {
    /// Bearings from -100 to 100 degrees, two entries a degree.
    const ENTRIES: u16 = 400;

    fn new(blade: &[Vec2]) -> Self {
        let mut radii = vec![f32::MAX; usize::from(Self::ENTRIES)];
        for pair in blade.iter().zip(blade.iter().cycle().skip(1)) {
            for i in 0..8_u8 {
                let p = pair.0.lerp(*pair.1, f32::from(i) / 8.0) - BASE;
                let slot = Self::slot(p.x.atan2(p.y).to_degrees());
                // Flanks near the petiole are no edge to stop at.
                if p.length() > 0.9 {
                    radii[slot] = radii[slot].min(p.length());
                }
            }
        }
        Self(radii)
    }

    fn slot(bearing_deg: f32) -> usize {
        let index = crate::math::floor_i32((bearing_deg + 100.0) * 2.0);
        usize::try_from(index).unwrap_or(0).min(usize::from(Self::ENTRIES) - 1)
    }

    fn at(&self, bearing_deg: f32) -> f32 {
        let slot = Self::slot(bearing_deg);
        let near = slot.saturating_sub(1)..(slot + 2).min(self.0.len());
        self.0[near].iter().copied().fold(f32::MAX, f32::min).min(2.4)
    }
}
