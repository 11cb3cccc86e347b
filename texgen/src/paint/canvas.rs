// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometry of a leaf on a texel grid: coverage, veins and distances.

use glam::Vec2;

use crate::distance;
use crate::math::{floor_i32, segment_distance, smoothstep};
use crate::raster::{Frame, coverage, stroke};

/// Rank of a vein.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// Midrib and the ribs of lobes.
    Primary,
    /// Laterals of a rib.
    Secondary,
    /// Fine veins between laterals.
    Tertiary,
}

/// Straight piece of a vein, in leaf coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    /// Its two ends.
    pub(super) ends: [Vec2; 2],
    /// Radius at each end.
    pub(super) radii: [f32; 2],
    /// Rank of the vein.
    pub(super) order: Order,
}

/// Margin of a blade and its petiole, in leaf coordinates.
pub(super) struct Outline {
    /// Margin of the blade: a closed polygon, counter-clockwise, first point not repeated.
    pub(super) blade: Vec<Vec2>,
    /// Points of the petiole from its free end to the blade, with the radius at each.
    pub(super) petiole: Vec<(Vec2, f32)>,
}

/// Geometry that the colour of one texel depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Leaf coordinates.
    pub(super) at: Vec2,
    /// Distance to the margin in leaf units.
    pub(super) margin: f32,
    /// Distance to the nearest rib or lateral in leaf units.
    pub(super) vein: f32,
    /// Strength (0..=1) of the veins of each order that pass through the texel.
    pub(super) strokes: [f32; 3],
    /// Share of the texel that shows the petiole.
    pub(super) petiole: f32,
    /// Slope towards the light of the puckered blade, about -1..1.
    pub(super) slope: f32,
}

/// A leaf's geometry on a texel grid.
pub(super) struct Canvas {
    frame: Frame,
    /// Share of each texel that the leaf covers.
    pub(super) coverage: Vec<f32>,
    petiole: Vec<f32>,
    margin: Vec<f32>,
    vein: Vec<f32>,
    strokes: Vec<[f32; 3]>,
}

impl Canvas {
    /// Rasterises a leaf.
    pub(super) fn new(outline: &Outline, veins: &[Stroke], frame: Frame) -> Self {
        let size = frame.size;
        let stem = stroke(&outline.petiole);
        let blade = coverage(&[&outline.blade], frame);
        let mut petiole = coverage(&[&stem], frame);
        let whole = coverage(&[&outline.blade, &stem], frame);
        for (stem, blade) in petiole.iter_mut().zip(&blade) {
            *stem *= 1.0 - blade;
        }
        let unit = 1.0 / frame.scale;
        let margin: Vec<f32> = distance::to_seeds(size, |i| whole[i] < 0.5)
            .into_iter()
            .map(|d| (d - 0.5).max(0.0) * unit)
            .collect();
        let seeds = main_vein_seeds(veins, frame);
        let vein: Vec<f32> = distance::to_seeds(size, |i| seeds[i]).into_iter().map(|d| d * unit).collect();
        let strokes = paint_strokes(veins, frame);
        Self { frame, coverage: whole, petiole, margin, vein, strokes }
    }

    /// Conditions at a texel.
    pub(super) fn spot(&self, index: usize) -> Spot {
        let size = self.frame.size;
        let (x, y) = (index % size, index / size);
        let at = self.frame.texel_centre(x, y);
        let height = |x: usize, y: usize| {
            let i = y.min(size - 1) * size + x.min(size - 1);
            1.0 - (-self.vein[i] / 0.045).exp() - 0.25 * self.strokes[i][2]
        };
        let texel = self.frame.scale * 0.5;
        let rise = (height(x + 1, y + 1) - height(x.saturating_sub(1), y.saturating_sub(1))) * texel;
        Spot {
            at,
            margin: self.margin[index],
            vein: self.vein[index],
            strokes: self.strokes[index],
            petiole: self.petiole[index],
            slope: (rise * 0.07).clamp(-1.0, 1.0),
        }
    }
}

/// Texel that holds a leaf point, if it is on the grid.
fn texel_index(frame: Frame, p: Vec2) -> Option<usize> {
    let texel = frame.to_texel(p);
    let x = usize::try_from(floor_i32(texel.x)).ok()?;
    let y = usize::try_from(floor_i32(texel.y)).ok()?;
    (x < frame.size && y < frame.size).then_some(y * frame.size + x)
}

/// Texels on the centre lines of ribs and laterals.
fn main_vein_seeds(veins: &[Stroke], frame: Frame) -> Vec<bool> {
    let mut seeds = vec![false; frame.size * frame.size];
    for Stroke { ends: [from, to], .. } in veins.iter().filter(|vein| vein.order != Order::Tertiary) {
        let steps = 1 + floor_i32(from.distance(*to) * frame.scale * 1.5).max(0);
        for step in 0..=steps {
            let p = from.lerp(*to, step as f32 / steps as f32);
            if let Some(index) = texel_index(frame, p) {
                seeds[index] = true;
            }
        }
    }
    seeds
}

/// Strength of the veins of each order at each texel. Veins thinner than a texel fade instead of breaking up.
fn paint_strokes(veins: &[Stroke], frame: Frame) -> Vec<[f32; 3]> {
    let mut strokes = vec![[0.0_f32; 3]; frame.size * frame.size];
    let clamp = |x: f32| usize::try_from(floor_i32(x)).unwrap_or(0).min(frame.size);
    for Stroke { ends, radii, order } in veins {
        let order = match order {
            Order::Primary => 0,
            Order::Secondary => 1,
            Order::Tertiary => 2,
        };
        let [a, b] = ends.map(|end| frame.to_texel(end));
        let widest = (radii[0].max(radii[1]) * frame.scale).max(0.5) + 1.0;
        let (low, high) = (a.min(b) - widest, a.max(b) + widest);
        for y in clamp(low.y)..clamp(high.y + 1.0) {
            for x in clamp(low.x)..clamp(high.x + 1.0) {
                let centre = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let (distance, t) = segment_distance(centre, a, b);
                let radius = (radii[0] + (radii[1] - radii[0]) * t) * frame.scale;
                let drawn = radius.max(0.5);
                let strength = smoothstep(drawn + 0.5, (drawn - 0.7).max(0.0), distance) * (radius / drawn);
                let slot = &mut strokes[y * frame.size + x][order];
                *slot = slot.max(strength);
            }
        }
    }
    strokes
}
