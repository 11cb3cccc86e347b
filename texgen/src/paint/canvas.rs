// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is where on the texel grid: coverage, veins and distances.

use glam::Vec2;

use crate::contour::Outline;
use crate::damage::Damage;
use crate::distance;
use crate::math::{floor_i32, segment_distance, smoothstep};
use crate::raster::{Frame, coverage, stroke};
use crate::rng::Rng;
use crate::veins::{Order, Vein};

/// Margin around the leaf as a share of the image's side.
const MARGIN: f32 = 0.016;

/// Everything that the colour of one texel depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Leaf coordinates.
    pub(super) at: Vec2,
    /// Distance to the margin or a hole in leaf units.
    pub(super) margin: f32,
    /// Distance to the nearest hole's rim in leaf units.
    pub(super) hole: f32,
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
    damage: Damage,
}

impl Canvas {
    /// Rasterises a leaf.
    pub(super) fn new(outline: &Outline, veins: &[Vein], size: usize, season: f32, rng: &mut Rng) -> Self {
        let stem = stroke(&outline.petiole);
        let border = MARGIN * size as f32;
        let frame = Frame::around(outline.blade.iter().chain(&stem).copied(), size, border);
        let mut canvas = Self::whole(outline, veins, frame);
        let blade = coverage(&[&outline.blade], frame);
        let room = |p: Vec2| {
            texel_index(frame, p)
                .map_or(-1.0, |i| if blade[i] < 0.9 { -1.0 } else { canvas.margin[i].min(canvas.vein[i]) })
        };
        let damage = Damage::draw(outline, season, room, rng);
        for (i, covered) in canvas.coverage.iter_mut().enumerate().filter(|(_, covered)| **covered > 0.0) {
            let hole = damage.distance(frame.texel_centre(i % size, i / size)) * frame.scale + 0.5;
            // Holes spare the petiole.
            *covered *= hole.clamp(canvas.petiole[i], 1.0);
        }
        canvas.damage = damage;
        drop_islands(&mut canvas.coverage, size);
        canvas
    }

    /// Rasterises a leaf without damage.
    pub(super) fn whole(outline: &Outline, veins: &[Vein], frame: Frame) -> Self {
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
        Self { frame, coverage: whole, petiole, margin, vein, strokes, damage: Damage::default() }
    }

    /// Conditions at a texel.
    pub(super) fn spot(&self, index: usize) -> Spot {
        let size = self.frame.size;
        let (x, y) = (index % size, index / size);
        let at = self.frame.texel_centre(x, y);
        let hole = self.damage.distance(at);
        let height = |x: usize, y: usize| {
            let i = y.min(size - 1) * size + x.min(size - 1);
            1.0 - (-self.vein[i] / 0.045).exp() - 0.25 * self.strokes[i][2]
        };
        let texel = self.frame.scale * 0.5;
        let rise = (height(x + 1, y + 1) - height(x.saturating_sub(1), y.saturating_sub(1))) * texel;
        Spot {
            at,
            margin: self.margin[index].min(hole.max(0.0)),
            hole,
            vein: self.vein[index],
            strokes: self.strokes[index],
            petiole: self.petiole[index],
            slope: (rise * 0.07).clamp(-1.0, 1.0),
        }
    }
}

/// Clears whatever bites cut off: all but the largest connected part.
fn drop_islands(coverage: &mut [f32], size: usize) {
    const UNSEEN: usize = usize::MAX;
    let mut part_of = vec![UNSEEN; coverage.len()];
    let mut sizes = Vec::new();
    let mut stack = Vec::new();
    for start in 0..coverage.len() {
        if coverage[start] <= 0.0 || part_of[start] != UNSEEN {
            continue;
        }
        let part = sizes.len();
        sizes.push(0_usize);
        part_of[start] = part;
        stack.push(start);
        while let Some(at) = stack.pop() {
            sizes[part] += 1;
            let (x, y) = (at % size, at / size);
            let sides = [
                (x > 0).then(|| at - 1),
                (x + 1 < size).then(|| at + 1),
                (y > 0).then(|| at - size),
                (y + 1 < size).then(|| at + size),
            ];
            for next in sides.into_iter().flatten() {
                // Faint fringes do not hold two parts together.
                if coverage[next] > 0.0 && part_of[next] == UNSEEN && coverage[at].max(coverage[next]) > 0.3 {
                    part_of[next] = part;
                    stack.push(next);
                }
            }
        }
    }
    let largest = (0..sizes.len()).max_by_key(|&part| sizes[part]);
    for (texel, part) in coverage.iter_mut().zip(part_of) {
        if Some(part) != largest {
            *texel = 0.0;
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
fn main_vein_seeds(veins: &[Vein], frame: Frame) -> Vec<bool> {
    let mut seeds = vec![false; frame.size * frame.size];
    for vein in veins.iter().filter(|vein| vein.order != Order::Tertiary) {
        for pair in vein.points.windows(2) {
            let steps = 1 + floor_i32(pair[0].distance(pair[1]) * frame.scale * 1.5).max(0);
            for step in 0..=steps {
                let p = pair[0].lerp(pair[1], step as f32 / steps as f32);
                if let Some(index) = texel_index(frame, p) {
                    seeds[index] = true;
                }
            }
        }
    }
    seeds
}

/// Strength of the veins of each order at each texel. Veins thinner than a texel fade instead of breaking up.
fn paint_strokes(veins: &[Vein], frame: Frame) -> Vec<[f32; 3]> {
    let mut strokes = vec![[0.0_f32; 3]; frame.size * frame.size];
    let clamp = |x: f32| usize::try_from(floor_i32(x)).unwrap_or(0).min(frame.size);
    for vein in veins {
        let order = match vein.order {
            Order::Primary => 0,
            Order::Secondary => 1,
            Order::Tertiary => 2,
        };
        for (pair, radii) in vein.points.windows(2).zip(vein.radii.windows(2)) {
            let (a, b) = (frame.to_texel(pair[0]), frame.to_texel(pair[1]));
            let widest = (radii[0].max(radii[1]) * frame.scale).max(0.5) + 1.0;
            let (low, high) = (a.min(b) - widest, a.max(b) + widest);
            for y in clamp(low.y)..clamp(high.y + 1.0) {
                for x in clamp(low.x)..clamp(high.x + 1.0) {
                    let centre = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                    let (distance, t) = segment_distance(centre, a, b);
                    let radius = (radii[0] + (radii[1] - radii[0]) * t) * frame.scale;
                    let drawn = radius.max(0.5);
                    let strength =
                        smoothstep(drawn + 0.5, (drawn - 0.7).max(0.0), distance) * (radius / drawn);
                    let slot = &mut strokes[y * frame.size + x][order];
                    *slot = slot.max(strength);
                }
            }
        }
    }
    strokes
}
