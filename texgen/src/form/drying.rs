// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf dries: water leaves through the margin, tissue shrinks more than veins, and the blade curls.
//!
//! The two sides of a blade shrink by different amounts (a bilayer), which wants to bend it; shrinking unevenly
//! between stiff veins creases it (after Jeong et al. 2013). Here water diffuses from corner to corner of a mesh, fast
//! along veins; rest lengths and rest angles follow the water; a solver finds the shape of every stage.

use glam::{Mat3, Vec2, Vec3};

use super::bending::{Hinge, Stretch, fold, hinges, keep_open, normals, pull};
use super::mesh::LeafMesh;
use crate::math::{lerp, single, smoothstep};
use crate::noise;
use crate::rng::Rng;
use crate::{Blade, Shape};

/// Rounds of the whole drying.
const ROUNDS: u32 = 320;
/// Solver passes in a round.
const PASSES: u32 = 12;
/// Passes at the end that open triangles about to turn over and set the veins' lengths.
const OPENING_PASSES: u32 = 40;
/// Most repetitions of those passes while a triangle is still inverted.
const OPENING_ROUNDS: u32 = 12;
/// Most repetitions of the passes that tighten a sheet.
const TIGHTENING_ROUNDS: u32 = 48;
/// Share of its area at most that a blade keeps from one stage to the next.
const SMALLER: f32 = 0.9995;
/// Solver passes of a stage that starts from a coarser level.
const FINE_PASSES: u32 = 80;
/// Most that a vein shortens by itself; with what a sheet shrinks as a whole it stays within 6 %.
const VEIN_SHRINKAGE: f32 = 0.04;

/// How a leaf dries.
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
    /// Where each corner moves from the flat mesh: x and y as in the picture (y down), z towards the upper side's viewer,
    /// all in pixels. The first corner, at the petiole, stays.
    pub offsets: Vec<Vec3>,
}

impl Default for Drying {
    fn default() -> Self {
        Self { shrinkage: 0.25, curl: 1.9, roll: 0.55, unevenness: 0.5, stages: 5 }
    }
}

impl Drying {
    /// How leaves of a kind dry.
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
                least_area = least_area.min(sheet.area());
                shapes.push(sheet.shape());
            }
        }
        shapes
    }
}

/// Where a corner lies in a coarser mesh: a triangle's corners and their shares.
type Footing = ([usize; 3], [f32; 3]);

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

/// A mesh in space with its water.
struct Sheet {
    flat: Vec<Vec3>,
    positions: Vec<Vec3>,
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
    fn new(drying: &Drying, mesh: &LeafMesh, blade: &Blade, seed: u64) -> Self {
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
    fn lose_water(&mut self, round: u32) {
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
    fn shrink(&mut self, drying: &Drying) {
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
    fn settle(&mut self, passes: u32) {
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
    fn tighten(&mut self, least_area: f32) {
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

    /// Area in space.
    fn area(&self) -> f32 {
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

    /// Whether a triangle faces against those around it.
    fn any_inverted(&self) -> bool {
        let normals = normals(&self.positions, &self.triangles);
        self.triangles.iter().any(|t| {
            let [a, b, c] = t.map(|i| self.positions[i as usize]);
            let around: Vec3 = t.iter().map(|i| normals[*i as usize]).sum();
            (b - a).cross(c - a).dot(around) <= 0.0
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
    fn start_from(&mut self, footings: &[Footing], shape: &BlendShape) {
        for ((position, flat), (corners, shares)) in self.positions.iter_mut().zip(&self.flat).zip(footings) {
            let offset: Vec3 = corners.iter().zip(shares).map(|(i, share)| shape.offsets[*i] * *share).sum();
            *position = *flat + Vec3::new(offset.x, -offset.y, offset.z);
        }
    }

    /// Offsets from the flat sheet, the first corner held.
    fn shape(&self) -> BlendShape {
        let held = self.positions.first().zip(self.flat.first()).map_or(Vec3::ZERO, |(p, flat)| *p - *flat);
        let offsets = self.positions.iter().zip(&self.flat).map(|(p, flat)| {
            let moved = *p - *flat - held;
            Vec3::new(moved.x, -moved.y, moved.z)
        });
        let water = self.water.iter().sum::<f32>() / self.water.len().max(1) as f32;
        BlendShape { water, offsets: offsets.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VeinGrower;
    use crate::form::Detail;
    use crate::growth::SpeciesVeins;
    use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};
    use proptest::test_runner::TestCaseError;

    fn leaf(shape: Shape, seed: u64) -> (Blade, Vec<LeafMesh>) {
        let blade = shape.draw(256, seed).expect("the size is allowed").blade;
        let veins = SpeciesVeins::of(shape).grow(&blade, seed).expect("a leaf has room");
        let mesh = |detail| LeafMesh::build(&blade, &veins, detail).expect("the outline is simple");
        let meshes = Detail::ALL.map(mesh).into();
        (blade, meshes)
    }

    /// Corners in space, y up.
    fn placed(mesh: &LeafMesh, shape: &BlendShape) -> Vec<Vec3> {
        let flat = mesh.positions.iter().map(|p| Vec3::new(p.x, -p.y, 0.0));
        flat.zip(&shape.offsets).map(|(p, o)| p + Vec3::new(o.x, -o.y, o.z)).collect()
    }

    fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
        let doubled = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            (b - a).cross(c - a).length()
        };
        triangles.iter().map(doubled).sum::<f32>() / 2.0
    }

    /// How far the sides stand above the middle, as a share of √A.
    fn curl(mesh: &LeafMesh, shape: &BlendShape) -> f32 {
        let positions = placed(mesh, shape);
        let normals = normals(&positions, &mesh.triangles);
        let mut sum = 0.0;
        for hinge in hinges(&positions, &mesh.triangles) {
            let [a, b, c, d] = hinge.corners;
            let normal = (normals[a] + normals[b]).normalize_or(Vec3::Z);
            sum += (positions[c] + positions[d] - positions[a] - positions[b]).dot(normal);
        }
        sum
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn drying_keeps_the_rules(seed in any::<u64>(), which in 0..Shape::ALL.len()) {
            let shape = Shape::ALL[which];
            let (blade, meshes) = leaf(shape, seed);
            let levels = Drying::of(shape).dry(&meshes, &blade, seed);
            prop_assert!(levels.len() == 3, "{} levels", levels.len());
            for (level, (mesh, stages)) in meshes.iter().zip(&levels).enumerate() {
                let name = format!("{shape:?}, level {level}");
                prop_assert!(stages.len() == 5, "{name}: {} stages", stages.len());
                check(&name, mesh, stages)?;
            }
        }
    }

    /// Leaves whose last stage would come out larger than the one before.
    #[test]
    fn strongly_curled_leaves_keep_the_rules() {
        for seed in [6_619_659_668_256_556_801, 4_081_852_302_334_879_115] {
            let (blade, meshes) = leaf(Shape::Linden, seed);
            for (mesh, stages) in meshes.iter().zip(Drying::of(Shape::Linden).dry(&meshes, &blade, seed)) {
                check("Linden", mesh, &stages).unwrap_or_else(|problem| panic!("{problem}"));
            }
        }
    }

    /// Area falls, veins keep their length, no triangle turns over.
    fn check(name: &str, mesh: &LeafMesh, stages: &[BlendShape]) -> Result<(), TestCaseError> {
        let flat: Vec<Vec3> = mesh.positions.iter().map(|p| Vec3::new(p.x, -p.y, 0.0)).collect();
        let fresh = area(&flat, &mesh.triangles);
        let mut last = fresh;
        let length = |positions: &[Vec3]| -> f32 {
            let far = |[a, b]: &[u32; 2]| positions[*a as usize].distance(positions[*b as usize]);
            mesh.vein_edges.iter().map(|(ends, _)| far(ends)).sum()
        };
        for (stage, blend) in stages.iter().enumerate() {
            let positions = placed(mesh, blend);
            prop_assert!(positions.iter().all(|p| p.is_finite()), "{name}: stage {stage} is not finite");
            prop_assert!(blend.offsets[0].length() < 1e-4, "{name}: the petiole's end moves");
            let now = area(&positions, &mesh.triangles);
            prop_assert!(now < last, "{name}: area grows from {last} to {now} at stage {stage}");
            last = now;
            let veins = length(&positions) / length(&flat).max(1e-6);
            let none = mesh.vein_edges.is_empty();
            prop_assert!(
                none || (0.94..=1.01).contains(&veins),
                "{name}: veins are {veins} long at stage {stage}"
            );
            let normals = normals(&positions, &mesh.triangles);
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| positions[i as usize]);
                let around: Vec3 = t.iter().map(|i| normals[*i as usize]).sum();
                let upright = (b - a).cross(c - a).dot(around) > 0.0;
                prop_assert!(upright, "{name}: a triangle is inverted at stage {stage}");
            }
        }
        prop_assert!(last < 0.95 * fresh, "{name}: dry area is {} of the fresh", last / fresh);
        prop_assert!(stages[4].water < 0.1, "{name}: {} of the water is left", stages[4].water);
        Ok(())
    }

    #[test]
    fn the_other_bilayer_curls_the_other_way() {
        for shape in [Shape::Beech, Shape::Maple, Shape::Hornbeam] {
            let (blade, meshes) = leaf(shape, 5);
            let up = Drying { curl: 1.8, ..Drying::of(shape) };
            let down = Drying { curl: -1.8, ..up };
            let [up, down] = [up, down].map(|drying| drying.dry(&meshes, &blade, 5));
            for (level, mesh) in meshes.iter().enumerate() {
                let (up, down) = (curl(mesh, &up[level][4]), curl(mesh, &down[level][4]));
                assert!(up > 0.0 && down < 0.0, "{shape:?}, level {level} curls {up} and {down}");
            }
        }
    }

    #[test]
    fn same_seed_same_shape() {
        let (blade, meshes) = leaf(Shape::Birch, 2);
        let [a, b, c] = [7, 7, 8].map(|seed| Drying::default().dry(&meshes[..1], &blade, seed));
        assert!(a == b && a != c, "the seed alone decides");
    }
}
