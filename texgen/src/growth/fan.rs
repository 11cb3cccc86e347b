// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The forking veins of a fan: each splits in two whenever there is room, none ever meet again.

use std::f32::consts::{PI, TAU};

use glam::Vec2;

use super::draft::Draft;
use super::ground::Ground;
use super::route::rotate;
use crate::math::{floor_i32, lerp, smoothstep};
use crate::rng::Rng;

/// Room for a vein, as a share of √A, at which it forks.
const FORK: f32 = 0.062;
/// Rings of the table of flanks.
const RINGS: usize = 128;

/// Opening of a fan to either side, ring by ring around the root.
struct Flanks {
    axis: Vec2,
    spacing: f32,
    /// Angles in radians from the axis to the left (negative) and right flank.
    rings: Vec<(f32, f32)>,
}

impl Flanks {
    fn survey(ground: &Ground) -> Self {
        let axis = (ground.tip - ground.root).normalize_or(Vec2::NEG_Y);
        let farthest = ground.extent() * 1.5;
        let spacing = farthest / RINGS as f32;
        let mut rings = Vec::with_capacity(RINGS);
        let mut widest = (0.0_f32, 0.0_f32);
        for ring in 0..RINGS {
            let radius = (ring as f32 + 0.5) * spacing;
            let mut open: Option<(f32, f32)> = None;
            let steps = floor_i32(TAU * radius).clamp(90, 1440);
            for step in 0..steps {
                let turn = (step as f32 / steps as f32 - 0.5) * TAU;
                if ground.contains(ground.root + rotate(axis, turn) * radius) {
                    let (low, high) = open.unwrap_or((turn, turn));
                    open = Some((low.min(turn), high.max(turn)));
                }
            }
            let (low, high) = open.unwrap_or(widest);
            // Past its corners a fan's flanks go on straight: the outer edge is no flank.
            widest = if radius < 0.2 * ground.unit || ring == 0 {
                (low, high)
            } else {
                (low.min(widest.0), high.max(widest.1))
            };
            rings.push((widest.0.max(-PI), widest.1.min(PI)));
        }
        Self { axis, spacing, rings }
    }

    /// Direction from the root of the vein that lies a share of the way (-1 left, 1 right) at a radius.
    fn direction(&self, share: f32, radius: f32) -> Vec2 {
        rotate(self.axis, share * self.half_angle(share, radius) * 0.97)
    }

    fn half_angle(&self, share: f32, radius: f32) -> f32 {
        let x = (radius / self.spacing - 0.5).clamp(0.0, (RINGS - 2) as f32);
        let ring = usize::try_from(floor_i32(x)).unwrap_or(0);
        let pick = |i: usize| if share < 0.0 { -self.rings[i].0 } else { self.rings[i].1 };
        lerp(pick(ring), pick(ring + 1), x - ring as f32).max(0.0)
    }
}

/// A vein that still grows.
struct Bud {
    node: u32,
    /// Position between the flanks, -1 to 1.
    share: f32,
    /// Place that it heads for, and width of the band that it feeds.
    goal: f32,
    band: f32,
    radius: f32,
    fork_width: f32,
    order: u8,
}

/// Grows a fan into a draft that holds only a root.
pub(super) fn grow(draft: &mut Draft<'_>, rng: &mut Rng) {
    let ground = draft.ground;
    let flanks = Flanks::survey(ground);
    let unit = ground.unit;
    let stem = Bud {
        node: 0,
        share: 0.0,
        goal: 0.0,
        band: 2.0,
        radius: 0.0,
        fork_width: 0.4 * FORK * unit,
        order: 1,
    };
    let mut buds = vec![stem];
    // Ring by ring, all buds together: an older vein never runs ahead into a younger one's way.
    while !buds.is_empty() {
        let mut next = Vec::new();
        for mut bud in buds {
            bud.radius += draft.step;
            bud.share = lerp(bud.share, bud.goal, 0.11);
            let direction = flanks.direction(bud.share, bud.radius);
            let Ok(node) = draft.grow(bud.node, ground.root + direction * bud.radius, bud.order, 0.05) else {
                continue;
            };
            bud.node = node;
            let width = bud.band * flanks.half_angle(bud.share, bud.radius) * bud.radius;
            if width < bud.fork_width {
                next.push(bud);
                continue;
            }
            for daughter in [-0.25, 0.25] {
                next.push(Bud {
                    goal: bud.goal + daughter * bud.band,
                    band: bud.band * 0.5,
                    // Forks crowd at the base, so that all flanks are reached from there.
                    fork_width: FORK * unit * rng.range(0.8, 1.6) * smoothstep(-0.1, 0.35, bud.radius / unit),
                    order: if bud.band > 0.9 {
                        1
                    } else if bud.band > 0.2 {
                        2
                    } else {
                        3
                    },
                    ..bud
                });
            }
        }
        buds = next;
    }
}
