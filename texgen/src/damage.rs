// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Insect holes and bites.

use glam::Vec2;

use crate::contour::Outline;
use crate::noise;
use crate::rng::Rng;

/// A hole in the blade, or a bite out of its margin.
#[derive(Clone, Copy, Debug)]
struct Hole {
    centre: Vec2,
    radius: f32,
    /// Stretch along x; the inverse applies along y.
    stretch: f32,
    seed: u64,
}

/// What insects left.
#[derive(Clone, Debug, Default)]
pub(crate) struct Damage {
    holes: Vec<Hole>,
}

impl Damage {
    /// Draws damage. `room` is the distance from a point to the margin or a main vein, negative outside the blade.
    pub(crate) fn draw(outline: &Outline, season: f32, room: impl Fn(Vec2) -> f32, rng: &mut Rng) -> Self {
        let mut holes = Vec::new();
        if rng.chance(0.12 + 0.16 * season) {
            for _ in 0..rng.integer(1, 4) {
                let centre = Vec2::new(rng.range(-1.2, 1.2), rng.range(-0.8, 0.8));
                let radius = rng.range(0.014, 0.05);
                if room(centre) > radius * 1.3 {
                    holes.push(Hole { centre, radius, stretch: rng.range(0.75, 1.3), seed: rng.bits() });
                }
            }
        }
        if rng.chance(0.06 + 0.1 * season) {
            let pick = rng.range(0.12, 0.88) * outline.blade.len() as f32;
            let at = outline.blade.iter().zip(0_u16..).find(|(_, i)| f32::from(*i) >= pick).map(|(p, _)| *p);
            holes.extend(at.filter(|p| p.x.abs() > 0.3 && p.y > -0.9).map(|centre| Hole {
                centre,
                radius: rng.range(0.05, 0.12),
                stretch: rng.range(0.7, 1.4),
                seed: rng.bits(),
            }));
        }
        Self { holes }
    }

    /// Distance in leaf units from a point to the nearest hole, negative inside one.
    pub(crate) fn distance(&self, p: Vec2) -> f32 {
        let from_hole = |hole: &Hole| {
            let offset = (p - hole.centre) * Vec2::new(1.0 / hole.stretch, hole.stretch);
            let wobble = noise::fractal(hole.seed, p * 1.1 / hole.radius, 2);
            offset.length() - hole.radius * (1.0 + 0.3 * wobble)
        };
        self.holes.iter().map(from_hole).fold(f32::MAX, f32::min)
    }
}
