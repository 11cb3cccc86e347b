// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade as a thin sheet that loses water and finds its shape.

use glam::{Mat3, Vec2, Vec3};

use super::bending::{Hinge, Stretch, fold, hinges, keep_open, normals, pull};
use super::drying::{BlendShape, Drying};
use super::mesh::LeafMesh;
use crate::Blade;
use crate::math::{lerp, single, smoothstep};
use crate::noise;
use crate::rng::Rng;

/// Rounds of the whole drying.
pub(super) const ROUNDS: u32 = 320;
/// Solver passes in a round.
pub(super) const PASSES: u32 = 12;
/// Passes at the end that open triangles about to turn over and set the veins' lengths.
const OPENING_PASSES: u32 = 40;
/// Most repetitions of those passes while a triangle is still inverted.
const OPENING_ROUNDS: u32 = 12;
/// Most repetitions of the passes that tighten a sheet.
const TIGHTENING_ROUNDS: u32 = 48;
/// Share of its area at most that a blade keeps from one stage to the next.
const SMALLER: f32 = 0.9995;
/// The same for what is accepted: a sheet that was shrunk as a whole may miss the other by a rounding.
const BARELY_SMALLER: f32 = 0.9998;
/// Length of a leaf's veins, all together, over their fresh length, at any stage.
const VEIN_LENGTH: std::ops::RangeInclusive<f32> = 0.942..=1.009;
/// Share of its flat area that a triangle shows at least to those around it.
const OPEN: f32 = 1e-3;
/// Most that a vein shortens by itself; with what a sheet shrinks as a whole it stays within 6 %.
const VEIN_SHRINKAGE: f32 = 0.04;

/// Place of a corner in a coarser mesh: a triangle's corners and their shares.
pub(super) type Footing = ([usize; 3], [f32; 3]);

/// A mesh in space with its water.
pub(super) struct Sheet {
    flat: Vec<Vec3>,
    pub(super) positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Twice the area of each flat triangle.
    doubled: Vec<f32>,
    water: Vec<f32>,
    edges: Vec<Edge>,
    hinges: Vec<(Hinge, f32)>,
    at_margin: Vec<bool>,
    /// Share of the drying after which a place starts to lose water.
    delay: Vec<f32>,
}

/// Axes of a sheet: from its first corner to its middle, across, and along its mean normal.
fn frame_of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mat3 {
    let middle = positions.iter().copied().sum::<Vec3>() / positions.len().max(1) as f32;
    let corner = |i: u32| positions[i as usize];
    let normal: Vec3 =
        triangles.iter().map(|t| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]))).sum();
    let normal = normal.normalize_or(Vec3::Z);
    let ahead = middle - positions.first().copied().unwrap_or_default();
    let ahead = (ahead - normal * ahead.dot(normal)).normalize_or(normal.any_orthonormal_vector());
    Mat3::from_cols(ahead, normal.cross(ahead), normal)
}

/// An edge of the sheet.
struct Edge {
    stretch: Stretch,
    flat: f32,
    vein: bool,
}

impl Sheet {
    pub(super) fn new(drying: &Drying, mesh: &LeafMesh, blade: &Blade, seed: u64) -> Self {
        let rng = Rng::new(seed);
        let noise_seed = rng.fork(1).bits();
        let unit = single(mesh.area()).max(1.0).sqrt();
        // Up in space is up on paper, so that triangles wind counter-clockwise about +z.
        let flat: Vec<Vec3> = mesh.positions.iter().map(|p| Vec3::new(p.x, -p.y, 0.0)).collect();
        let veins: std::collections::BTreeSet<[u32; 2]> =
            mesh.vein_edges.iter().map(|([a, b], _)| [*a.min(b), *a.max(b)]).collect();
        let mut pairs = std::collections::BTreeSet::new();
        for t in &mesh.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                pairs.insert([a.min(b), a.max(b)]);
            }
        }
        // Veins come last in a pass and so have the last word.
        let mut edges: Vec<Edge> = pairs
            .iter()
            .map(|pair| {
                let ends = pair.map(|i| i as usize);
                let length = flat[ends[0]].distance(flat[ends[1]]);
                let vein = veins.contains(pair);
                let compliance = if vein { 0.0 } else { 1.0 };
                Edge { stretch: Stretch { ends, rest: length, compliance }, flat: length, vein }
            })
            .collect();
        edges.sort_by_key(|edge| edge.vein);
        let axis = (blade.tip - blade.root).normalize_or(Vec2::NEG_Y);
        let axis = Vec3::new(axis.x, -axis.y, 0.0);
        let hinges = hinges(&flat, &mesh.triangles)
            .into_iter()
            .map(|hinge| {
                let [a, b, ..] = hinge.corners;
                let along = (flat[b] - flat[a]).normalize_or_zero().dot(axis);
                let middle = (flat[a] + flat[b]) / (2.0 * unit);
                let swing = noise::fractal(noise_seed, middle.truncate() * 3.0, 2) * drying.unevenness;
                let roll = lerp(1.0, 2.0 * along * along, drying.roll);
                let bend = drying.curl / unit * roll * (1.0 + swing) * hinge.height * 0.67;
                (Hinge { compliance: 3.0, ..hinge }, bend)
            })
            .collect();
        let mut at_margin = vec![false; flat.len()];
        for i in mesh.margin_edges.iter().flatten() {
            at_margin[*i as usize] = true;
        }
        let delay = mesh
            .positions
            .iter()
            .map(|p| 0.15 + 0.15 * noise::value(noise_seed ^ 1, *p / unit * 2.5))
            .collect();
        let doubled = mesh.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| flat[i as usize]);
            (b - a).cross(c - a).z
        });
        Self {
            doubled: doubled.collect(),
            positions: flat.clone(),
            water: vec![1.0; flat.len()],
            triangles: mesh.triangles.clone(),
            flat,
            edges,
            hinges,
            at_margin,
            delay,
        }
    }

    /// Water leaves at the margin first, creeps along edges, and at last leaves everywhere.
    pub(super) fn lose_water(&mut self, round: u32) {
        let done = round as f32 / ROUNDS as f32;
        let before = self.water.clone();
        for edge in &self.edges {
            let [a, b] = edge.stretch.ends;
            let flow = (before[b] - before[a]) * if edge.vein { 0.12 } else { 0.03 };
            self.water[a] += flow;
            self.water[b] -= flow;
        }
        for (index, water) in self.water.iter_mut().enumerate() {
            // Neighbours never raise what has dried: the blade as a whole only dries.
            *water = water.min(before[index]);
            let begun = smoothstep(self.delay[index] - 0.15, self.delay[index] + 0.25, done);
            let rate = if self.at_margin[index] { 0.02 } else { 0.008 } + 0.03 * smoothstep(0.6, 1.0, done);
            *water = (*water * (1.0 - rate * begun)).clamp(0.0, 1.0);
        }
    }

    /// Sets lengths and angles at rest from the water: `l = l₀ (1 - s (1 - w))`.
    pub(super) fn shrink(&mut self, drying: &Drying) {
        let dryness = |i: usize| 1.0 - self.water[i];
        for edge in &mut self.edges {
            let [a, b] = edge.stretch.ends;
            let most = if edge.vein { VEIN_SHRINKAGE } else { drying.shrinkage.clamp(0.0, 0.4) };
            edge.stretch.rest = edge.flat * (1.0 - most * (dryness(a) + dryness(b)) / 2.0);
        }
        for (hinge, bend) in &mut self.hinges {
            let [a, b, c, d] = hinge.corners;
            hinge.angle = *bend * (dryness(a) + dryness(b) + dryness(c) + dryness(d)) / 4.0;
        }
    }

    /// Lets the sheet come to rest.
    pub(super) fn settle(&mut self, passes: u32) {
        for _ in 0..passes {
            let normals = normals(&self.positions, &self.triangles);
            for (hinge, _) in &self.hinges {
                fold(&mut self.positions, hinge, &normals);
            }
            for edge in &self.edges {
                pull(&mut self.positions, &edge.stretch);
            }
        }
        for _ in 0..OPENING_ROUNDS {
            self.open_up();
            if !self.any_inverted() {
                break;
            }
        }
        self.align();
    }

    /// Lets edges alone come to rest until the sheet is smaller than it was: where bending and veins pull against
    /// each other, a sheet that has not yet come to rest can be larger than a moister one. A sheet that resists, because
    /// the moister one was folded tighter, shrinks as a whole by the percent or so that is missing.
    pub(super) fn tighten(&mut self, least_area: f32) {
        for _ in 0..TIGHTENING_ROUNDS {
            if self.area() < SMALLER * least_area {
                break;
            }
            for edge in (0..PASSES).flat_map(|_| &self.edges) {
                pull(&mut self.positions, &edge.stretch);
            }
            self.open_up();
            self.align();
        }
        let share = SMALLER * least_area / self.area().max(1e-6);
        if share < 1.0 {
            let held = self.positions.first().copied().unwrap_or_default();
            for p in &mut self.positions {
                *p = held + (*p - held) * share.sqrt();
            }
        }
    }

    /// Goes back towards the stage before, which was sound, as far as it takes for this one to be sound too: no triangle
    /// turned over, veins as long as veins stay, and smaller than before. Rare tangles do not come open by themselves.
    pub(super) fn keep_sound(&mut self, before: &[Vec3], least_area: f32) {
        let wanted = self.positions.clone();
        let moved = before[0] - wanted[0];
        for share in [1.0, 0.8, 0.6, 0.4, 0.2, 0.1] {
            for ((position, old), new) in self.positions.iter_mut().zip(before).zip(&wanted) {
                *position = old.lerp(*new + moved, share);
            }
            let smaller = self.area() < BARELY_SMALLER * least_area;
            if smaller && !self.any_inverted() && self.veins_keep_their_length() {
                return;
            }
        }
        for (position, old) in self.positions.iter_mut().zip(before) {
            *position = before[0] + (*old - before[0]) * SMALLER.sqrt();
        }
    }

    /// Returns true if veins are as long as [`VEIN_LENGTH`] says, all of them together.
    fn veins_keep_their_length(&self) -> bool {
        let veins = || self.edges.iter().filter(|edge| edge.vein);
        let far = |edge: &Edge| {
            let [a, b] = edge.stretch.ends;
            self.positions[a].distance(self.positions[b])
        };
        let (now, flat) = (veins().map(far).sum::<f32>(), veins().map(|edge| edge.flat).sum::<f32>());
        flat <= 0.0 || VEIN_LENGTH.contains(&(now / flat))
    }

    /// Area in space.
    pub(super) fn area(&self) -> f32 {
        let doubled = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| self.positions[i as usize]);
            (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(doubled).sum::<f32>() / 2.0
    }

    /// Opens triangles that are about to turn over and sets the veins' lengths.
    fn open_up(&mut self) {
        for _ in 0..OPENING_PASSES {
            let normals = normals(&self.positions, &self.triangles);
            for edge in self.edges.iter().filter(|edge| edge.vein) {
                pull(&mut self.positions, &edge.stretch);
            }
            for (triangle, flat) in self.triangles.iter().zip(&self.doubled) {
                keep_open(&mut self.positions, triangle, *flat, &normals);
            }
        }
    }

    /// Returns true if a triangle faces against those around it.
    fn any_inverted(&self) -> bool {
        let normals = normals(&self.positions, &self.triangles);
        self.triangles.iter().zip(&self.doubled).any(|(t, flat)| {
            let [a, b, c] = t.map(|i| self.positions[i as usize]);
            let around: Vec3 = t.iter().map(|i| normals[*i as usize]).sum();
            (b - a).cross(c - a).dot(around) <= OPEN * flat
        })
    }

    /// Turns the sheet back to lie as the flat one: bending moves it about but shall not turn it as a whole.
    fn align(&mut self) {
        let (now, flat) = (frame_of(&self.positions, &self.triangles), frame_of(&self.flat, &self.triangles));
        let turn = flat * now.transpose();
        let held = self.positions.first().copied().unwrap_or_default();
        for p in &mut self.positions {
            *p = held + turn * (*p - held);
        }
    }

    /// Takes the shape of a coarser level.
    pub(super) fn start_from(&mut self, footings: &[Footing], shape: &BlendShape) {
        for ((position, flat), (corners, shares)) in self.positions.iter_mut().zip(&self.flat).zip(footings) {
            let offset: Vec3 = corners.iter().zip(shares).map(|(i, share)| shape.offsets[*i] * *share).sum();
            *position = *flat + Vec3::new(offset.x, -offset.y, offset.z);
        }
    }

    /// Offsets from the flat sheet, the first corner held.
    pub(super) fn shape(&self) -> BlendShape {
        let held = self.positions.first().zip(self.flat.first()).map_or(Vec3::ZERO, |(p, flat)| *p - *flat);
        let offsets = self.positions.iter().zip(&self.flat).map(|(p, flat)| {
            let moved = *p - *flat - held;
            Vec3::new(moved.x, -moved.y, moved.z)
        });
        let water = self.water.iter().sum::<f32>() / self.water.len().max(1) as f32;
        BlendShape { water, offsets: offsets.collect() }
    }
}
