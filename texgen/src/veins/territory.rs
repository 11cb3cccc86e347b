// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Additional laterals that march into the space no vein has claimed.

use glam::Vec2;

use super::{Order, Plan, Vein};
use crate::contour::Outline;
use crate::math::{floor_i32, path_length, point_along};
use crate::raster::{Frame, coverage};
use crate::rng::Rng;

/// Cells along each side of the grid.
const CELLS: usize = 160;
/// Length of a marching step in leaf units.
const STEP: f32 = 0.02;

/// Which cells are inside the blade and which are near a vein.
struct Territory {
    frame: Frame,
    inside: Vec<bool>,
    claimed: Vec<bool>,
}

impl Territory {
    fn new(outline: &Outline) -> Self {
        let frame = Frame::around(outline.blade.iter().copied(), CELLS, 1.0);
        let inside = coverage(&[&outline.blade], frame).iter().map(|c| *c > 0.9).collect();
        Self { frame, inside, claimed: vec![false; CELLS * CELLS] }
    }

    /// Index of the cell at a point, if it is in the blade.
    fn cell(&self, p: Vec2) -> Option<usize> {
        let texel = self.frame.to_texel(p);
        let x = usize::try_from(floor_i32(texel.x)).ok()?;
        let y = usize::try_from(floor_i32(texel.y)).ok()?;
        (x < CELLS && y < CELLS && self.inside[y * CELLS + x]).then_some(y * CELLS + x)
    }

    fn claim(&mut self, points: &[Vec2]) {
        for pair in points.windows(2) {
            for i in 0..8_u8 {
                if let Some(cell) = self.cell(pair[0].lerp(pair[1], f32::from(i) / 8.0)) {
                    self.claimed[cell] = true;
                }
            }
        }
    }

    /// True where a vein could run.
    fn is_free(&self, p: Vec2) -> bool {
        self.cell(p).is_some_and(|cell| !self.claimed[cell])
    }
}

/// Adds laterals between those that are there.
pub(super) fn fill(outline: &Outline, plan: &Plan, veins: &mut Vec<Vein>, rng: &mut Rng) {
    let mut territory = Territory::new(outline);
    for vein in veins.iter().filter(|vein| vein.order != Order::Tertiary) {
        territory.claim(&vein.points);
    }
    let hosts: Vec<Vec<Vec2>> =
        veins.iter().filter(|vein| vein.order != Order::Tertiary).map(|vein| vein.points.clone()).collect();
    for host in hosts {
        let length = path_length(&host);
        let mut at = plan.fill_spacing * rng.range(0.7, 1.1);
        let mut turn = if rng.chance(0.5) { 1.0 } else { -1.0 };
        while at < length * 0.9 {
            let (from, along) = point_along(&host, at / length);
            let angle = turn * (plan.divergence_deg + 8.0 + 6.0 * rng.bell()).to_radians();
            let path = march(&territory, from, along, angle, rng);
            if path.len() > 5 {
                territory.claim(&path);
                let radius = 0.0045 * (path.len() as f32 / 20.0).clamp(0.5, 1.0);
                veins.push(Vein::tapering(path, radius, radius * 0.5, Order::Tertiary));
            }
            turn = -turn;
            at += plan.fill_spacing * rng.range(0.45, 0.75);
        }
    }
}

/// Walks away from a host vein until something is in the way.
fn march(territory: &Territory, from: Vec2, along: Vec2, angle: f32, rng: &mut Rng) -> Vec<Vec2> {
    let mut direction = Vec2::from_angle(angle).rotate(along);
    let mut at = from + direction * 0.03;
    let mut path = vec![from];
    let bend = -angle * 0.012;
    let limit = rng.integer(14, 34);
    for _ in 0..limit {
        if !territory.is_free(at) || !territory.is_free(at + direction * STEP) {
            break;
        }
        path.push(at);
        direction = Vec2::from_angle(bend + 0.1 * rng.bell()).rotate(direction);
        at += direction * STEP;
    }
    path
}
