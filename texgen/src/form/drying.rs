// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf dries: water leaves through the margin, tissue shrinks more than veins, and the blade curls.
//!
//! The two sides of a blade shrink by different amounts (a bilayer), which wants to bend it; shrinking unevenly
//! between stiff veins creases it (after Jeong et al. 2013). Here water diffuses from corner to corner of a mesh, fast
//! along veins; rest lengths and rest angles follow the water; a solver finds the shape of every stage.

use glam::{Vec2, Vec3};

use super::mesh::LeafMesh;
use super::sheet::{Footing, PASSES, ROUNDS, Sheet};
use crate::{Blade, Shape};

/// Solver passes of a stage that starts from a coarser level.
const FINE_PASSES: u32 = 80;

/// Drying of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drying {
    /// Share by which dry tissue is shorter, 0 to 0.4.
    pub shrinkage: f32,
    /// Curvature of the dry blade times √A: positive curls towards the upper side, -6 to 6.
    pub curl: f32,
    /// Share of the curl that rolls about the midrib, 0 (a bowl) to 1 (a scroll).
    pub roll: f32,
    /// Unevenness of the curl from place to place, 0 to 1.
    pub unevenness: f32,
    /// Stages that are kept, 1 to 12.
    pub stages: u32,
}

/// Shape of a mesh at one stage of drying.
#[derive(Clone, Debug, PartialEq)]
pub struct BlendShape {
    /// Water left in the blade as a share of the fresh leaf's, 0 to 1.
    pub water: f32,
    /// Displacement of each corner from the flat mesh: x and y as in the picture (y down), z towards the upper side's viewer,
    /// all in pixels. The first corner, at the petiole, stays.
    pub offsets: Vec<Vec3>,
}

impl Default for Drying {
    fn default() -> Self {
        Self { shrinkage: 0.25, curl: 1.9, roll: 0.55, unevenness: 0.5, stages: 5 }
    }
}

impl Drying {
    /// Drying of the leaves of a kind.
    pub fn of(shape: Shape) -> Self {
        let (shrinkage, curl, roll) = match shape {
            Shape::Maple => (0.22, 1.8, 0.4),
            Shape::JapaneseMaple => (0.2, 2.1, 0.5),
            Shape::Oak => (0.16, 1.4, 0.6),
            Shape::Birch => (0.18, 1.3, 0.55),
            Shape::Beech => (0.15, 1.1, 0.7),
            Shape::Hornbeam => (0.2, 1.5, 0.75),
            Shape::Linden => (0.22, 1.9, 0.5),
            Shape::Ginkgo => (0.12, -0.9, 0.35),
        };
        Self { shrinkage, curl, roll, ..Self::default() }
    }

    /// Dries a leaf that is meshed at several levels, the coarsest first; equal seeds give equal shapes. The stages of
    /// each level stand evenly between fresh and dry. Each level starts from the shapes of the one before, so that all
    /// curl alike and the finest, too, comes to rest.
    pub fn dry(&self, levels: &[LeafMesh], blade: &Blade, seed: u64) -> Vec<Vec<BlendShape>> {
        let mut all: Vec<Vec<BlendShape>> = Vec::new();
        for (index, mesh) in levels.iter().enumerate() {
            let coarser = index.checked_sub(1).map(|before| (carry(&levels[before], mesh), &all[before]));
            let mut sheet = Sheet::new(self, mesh, blade, seed);
            all.push(self.stages_of(&mut sheet, coarser));
        }
        all
    }

    /// Stages of one level.
    fn stages_of(
        &self,
        sheet: &mut Sheet,
        coarser: Option<(Vec<Footing>, &Vec<BlendShape>)>,
    ) -> Vec<BlendShape> {
        let stages = self.stages.clamp(1, 12);
        let mut shapes = Vec::new();
        let mut least_area = sheet.area();
        let mut before_last = sheet.positions.clone();
        for round in 1..=ROUNDS {
            sheet.lose_water(round);
            let kept = round * stages / ROUNDS > (round - 1) * stages / ROUNDS;
            match &coarser {
                None => {
                    sheet.shrink(self);
                    sheet.settle(PASSES);
                }
                Some((footings, before)) if kept => {
                    sheet.start_from(footings, &before[shapes.len()]);
                    sheet.shrink(self);
                    sheet.settle(FINE_PASSES);
                }
                Some(_) => {}
            }
            if kept {
                sheet.tighten(least_area);
                sheet.keep_sound(&before_last, least_area);
                before_last.clone_from(&sheet.positions);
                least_area = sheet.area();
                shapes.push(sheet.shape());
            }
        }
        shapes
    }
}

/// Finds the triangle of a coarser mesh under each corner, or the nearest one.
fn carry(from: &LeafMesh, to: &LeafMesh) -> Vec<Footing> {
    let footing = |p: &Vec2| {
        let mut best: Option<(f32, Footing)> = None;
        for t in &from.triangles {
            let corners = t.map(|i| i as usize);
            let [a, b, c] = corners.map(|i| from.positions[i]);
            let whole = (b - a).perp_dot(c - a);
            let shares = [(b - *p).perp_dot(c - *p), (c - *p).perp_dot(a - *p), (a - *p).perp_dot(b - *p)]
                .map(|part| part / whole);
            // Outside, how far in pixels the point lies beyond the triangle.
            let beyond = shares.into_iter().fold(f32::MAX, f32::min).min(0.0).abs() * whole.abs().sqrt();
            if best.is_none_or(|(least, _)| beyond < least) {
                best = Some((beyond, (corners, shares)));
            }
        }
        best.map_or(([0; 3], [1.0, 0.0, 0.0]), |(_, footing)| footing)
    };
    to.positions.iter().map(footing).collect()
}

#[cfg(test)]
mod tests;
