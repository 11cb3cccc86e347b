// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes of leaves as the shaders read them: every leaf picture's levels of detail as triangle strips over corners that
//! know where they lie at every stage of drying.
//!
//! One draw shows leaves of all pictures at one level, so a strip is looked up by the vertex's number; where it is
//! shorter than the longest its last corner is repeated. A corner takes 52 bytes, a piece of strip 2.

use glam::{Vec2, Vec3};
use windfall_core::{shared_constants, shared_struct};
use windfall_texgen::{Atlas, FormLevel, Layer};

use super::strip::strip;

/// Levels of detail, coarse first: a card of two triangles, then a leaf's meshes.
pub(crate) const LEVELS: usize = 4;
/// Stages of drying that a corner knows, besides the flat one.
pub(crate) const STAGES: usize = 5;

shared_constants! {
    /// Words of a corner: place on the picture, then two for each stage.
    const CORNER_WORDS: u32 = 13;
    /// Farthest that a corner lies from the middle, in sides of the picture.
    const REACH: f32 = 2.0;
    /// The last stage but one of drying: where a leaf lies between two stages, the first of them is this at most.
    const LAST_BUT_ONE_STAGE: u32 = 4;
}

shared_struct! {
    /// A mesh: a strip of corner numbers, and the corners.
    #[derive(Default)]
    pub(crate) struct LeafMesh {
        /// First piece of its strip.
        first_piece: u32,
        /// Pieces of the strip.
        piece_count: u32,
        /// First corner.
        first_corner: u32,
        /// Unused.
        unused: u32,
    }
}

/// All meshes of an atlas.
#[derive(Debug, Default)]
pub(crate) struct LeafMeshes {
    /// Corners, of [`CORNER_WORDS`] each.
    pub(crate) corners: Vec<u32>,
    /// Corner numbers, counted from a mesh's first, two to a word.
    pub(crate) strips: Vec<u32>,
    /// Meshes of each picture, level by level.
    pub(crate) meshes: Vec<LeafMesh>,
    /// Longest strip of each level.
    pub(crate) longest: [u32; LEVELS],
    /// For each picture: lowest and highest corner of its finest mesh at every stage, in sides, about the middle.
    pub(crate) heights: Vec<[[f32; 2]; STAGES + 1]>,
}

/// A mesh at every stage: places about the middle of the blade at that stage, x to the right, y down, z up, in sides.
struct Posed {
    places: Vec<Vec<Vec3>>,
    normals: Vec<Vec<Vec3>>,
}

impl LeafMeshes {
    pub(crate) fn new(atlas: &Atlas) -> Self {
        let mut forms = Self::default();
        let mut pieces: Vec<u16> = Vec::new();
        for layer in &atlas.layers {
            let finest = layer.form.levels.last();
            let middles: [Vec3; STAGES + 1] = std::array::from_fn(|stage| {
                finest.map_or(Vec3::new(0.5, 0.5, 0.0), |level| middle(level, &at_stage(level, stage), layer))
            });
            let card = layer.form.levels.first().map(|level| card(layer, level));
            let levels: Vec<&FormLevel> = card.iter().chain(&layer.form.levels).take(LEVELS).collect();
            for number in 0..LEVELS {
                let Some(level) = levels.get(number.min(levels.len().saturating_sub(1))) else {
                    forms.meshes.push(LeafMesh::default());
                    continue;
                };
                let strip = strip(&level.triangles);
                let whole = |count: usize| u32::try_from(count).unwrap_or(0);
                let mesh = LeafMesh {
                    first_piece: whole(pieces.len()),
                    piece_count: whole(strip.len()),
                    first_corner: whole(forms.corners.len() / CORNER_WORDS as usize),
                    unused: 0,
                };
                forms.meshes.push(mesh);
                forms.longest[number] = forms.longest[number].max(mesh.piece_count);
                pieces.extend(strip);
                forms.add_corners(level, &Posed::of(level, &middles));
            }
            let posed = finest.map(|level| Posed::of(level, &middles).places).unwrap_or_default();
            forms.heights.push(std::array::from_fn(|stage| {
                let heights = posed.get(stage).into_iter().flatten().map(|place| place.z);
                heights.fold([0.0_f32; 2], |[low, high], z: f32| [low.min(z), high.max(z)])
            }));
        }
        if pieces.len() % 2 == 1 {
            pieces.push(0);
        }
        forms.strips = pieces.chunks(2).map(|two| u32::from(two[0]) | u32::from(two[1]) << 16).collect();
        forms
    }

    fn add_corners(&mut self, level: &FormLevel, posed: &Posed) {
        for (index, [u, v]) in level.positions.iter().enumerate() {
            self.corners.push(unorm16(*u) | unorm16(*v) << 16);
            for (places, normals) in posed.places.iter().zip(&posed.normals) {
                let place = places[index] / REACH;
                let normal = octahedral(normals[index]);
                self.corners.push(two_shares(places[index].x, places[index].y));
                let direction = (snorm(normal.x, 127.0) & 0xff) << 16 | (snorm(normal.y, 127.0) & 0xff) << 24;
                self.corners.push(snorm(place.z, 32767.0) & 0xffff | direction);
            }
        }
    }
}

impl Posed {
    fn of(level: &FormLevel, middles: &[Vec3; STAGES + 1]) -> Self {
        let mut posed = Self { places: Vec::new(), normals: Vec::new() };
        for (stage, middle) in middles.iter().enumerate() {
            let places = at_stage(level, stage);
            posed.normals.push(normals(level, &places));
            posed.places.push(places.into_iter().map(|place| place - *middle).collect());
        }
        posed
    }
}

/// A level of a picture's meshes at a stage of drying: places about the middle of the blade and unit normals, x to the
/// right, y down, z up, in sides.
pub fn shaped(layer: &Layer, level: &FormLevel, stage: usize) -> (Vec<Vec3>, Vec<Vec3>) {
    let finest = layer.form.levels.last().unwrap_or(level);
    let middle = middle(finest, &at_stage(finest, stage), layer);
    let places = at_stage(level, stage);
    let normals = normals(level, &places);
    (places.into_iter().map(|place| place - middle).collect(), normals)
}

/// Corners at a stage, 0 flat to `STAGES` dry, whatever the number of shapes.
fn at_stage(level: &FormLevel, stage: usize) -> Vec<Vec3> {
    let flat = || level.positions.iter().map(|[x, y]| Vec3::new(*x, *y, 0.0));
    let at = (stage * level.shapes.len()) as f32 / STAGES as f32;
    let offset = |shape: usize, corner: usize| {
        shape.checked_sub(1).map_or(Vec3::ZERO, |shape| Vec3::from(level.shapes[shape].offsets[corner]))
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few shapes")]
    let before = at.floor() as usize;
    let after = (before + 1).min(level.shapes.len());
    let mixed = |(corner, place): (usize, Vec3)| {
        place + offset(before, corner).lerp(offset(after, corner), at - before as f32)
    };
    flat().enumerate().map(mixed).collect()
}

/// Middle of the blade's area; of a flat one as the picture has it.
fn middle(level: &FormLevel, places: &[Vec3], layer: &Layer) -> Vec3 {
    let flat: Vec<Vec3> = level.positions.iter().map(|[x, y]| Vec3::new(*x, *y, 0.0)).collect();
    let mean = |places: &[Vec3]| {
        let (mut sum, mut area) = (Vec3::ZERO, 0.0);
        for triangle in &level.triangles {
            let [a, b, c] = triangle.map(|i| i as usize);
            let share = (flat[b] - flat[a]).cross(flat[c] - flat[a]).length();
            sum += share * (places[a] + places[b] + places[c]) / 3.0;
            area += share;
        }
        sum / area.max(1.0e-9)
    };
    layer.centre.extend(0.0) + mean(places) - mean(&flat)
}

/// Unit normals of the upper side.
fn normals(level: &FormLevel, places: &[Vec3]) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; places.len()];
    for triangle in &level.triangles {
        let [a, b, c] = triangle.map(|i| i as usize);
        // Counter-clockwise with y up is clockwise with y down.
        let normal = (places[c] - places[a]).cross(places[b] - places[a]);
        let flat = |i: usize| Vec2::from(level.positions[i]);
        let sign = (flat(c) - flat(a)).perp_dot(flat(b) - flat(a)).signum();
        for corner in [a, b, c] {
            sums[corner] += sign * normal;
        }
    }
    sums.into_iter().map(|sum| sum.normalize_or(Vec3::Z)).collect()
}

/// The rectangle that a picture covers, moved at every shape as the plane does that fits a level's corners best.
fn card(layer: &Layer, level: &FormLevel) -> FormLevel {
    let (mut low, mut high) = (Vec2::ONE, Vec2::ZERO);
    for corner in level.positions.iter().map(|corner| Vec2::from(*corner)) {
        (low, high) = (low.min(corner), high.max(corner));
    }
    let positions = vec![low.to_array(), [high.x, low.y], [low.x, high.y], high.to_array()];
    let shapes = level.shapes.iter().map(|shape| {
        let mut normal = glam::DMat3::ZERO;
        let mut right = [glam::DVec3::ZERO; 3];
        for (position, offset) in level.positions.iter().zip(&shape.offsets) {
            let at = (Vec2::from(*position) - layer.centre).as_dvec2().extend(1.0);
            normal += glam::DMat3::from_cols(at * at.x, at * at.y, at);
            for (sum, offset) in right.iter_mut().zip(offset) {
                *sum += at * f64::from(*offset);
            }
        }
        let inverse = normal.inverse();
        let offset = |position: &[f32; 2]| {
            let at = (Vec2::from(*position) - layer.centre).as_dvec2().extend(1.0);
            right.map(|right| {
                #[expect(clippy::cast_possible_truncation, reason = "a share of a side")]
                let offset = (inverse * right).dot(at) as f32;
                if offset.is_finite() { offset } else { 0.0 }
            })
        };
        windfall_texgen::FormShape { water: shape.water, offsets: positions.iter().map(offset).collect() }
    });
    FormLevel {
        shapes: shapes.collect(),
        positions: positions.clone(),
        triangles: vec![[0, 2, 1], [1, 2, 3]],
    }
}

/// A unit vector on the octahedron, unfolded into a square of -1 to 1 (Meyer et al. 2010).
fn octahedral(n: Vec3) -> Vec2 {
    let flat = n.truncate() / (n.x.abs() + n.y.abs() + n.z.abs());
    if n.z >= 0.0 {
        return flat;
    }
    let sign = |x: f32| if x >= 0.0 { 1.0 } else { -1.0 };
    (Vec2::ONE - Vec2::new(flat.y, flat.x).abs()) * Vec2::new(sign(flat.x), sign(flat.y))
}

/// Two places in sides as the shaders read them.
pub(crate) fn two_shares(low: f32, high: f32) -> u32 {
    snorm(low / REACH, 32767.0) & 0xffff | snorm(high / REACH, 32767.0) << 16
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 16 bits")]
fn unorm16(x: f32) -> u32 {
    (x.clamp(0.0, 1.0) * 65535.0).round() as u32
}

/// Signed steps of a share, as the bits of a two's complement word.
#[expect(clippy::cast_possible_truncation, reason = "clamped to 16 bits")]
fn snorm(x: f32, steps: f32) -> u32 {
    ((x.clamp(-1.0, 1.0) * steps).round() as i32).cast_unsigned()
}

#[cfg(test)]
mod tests {
    use windfall_texgen::{Assortment, Shape};

    use super::*;

    fn atlas() -> Atlas {
        let assortment =
            Assortment { shape: Shape::Birch, season: (0.6, 0.6), count: 1, size_px: 64, seed: 3 };
        let folder = assortment.make(|| {}).expect("allowed numbers");
        let layers = folder.leaves.iter().map(|leaf| Layer::of_leaf(leaf, 64)).collect();
        Atlas { size_px: 64, variants: 1, layers }
    }

    /// Record of a corner at a stage, for the shader.
    fn read(forms: &LeafMeshes, corner: usize, stage: usize) -> Vec3 {
        let words = &forms.corners[corner * CORNER_WORDS as usize + 1 + 2 * stage..];
        let half = |word: u32| {
            #[expect(clippy::cast_possible_truncation, reason = "the low half")]
            let low = word as u16;
            f32::from(low.cast_signed()) / 32767.0 * REACH
        };
        Vec3::new(half(words[0]), half(words[0] >> 16), half(words[1]))
    }

    #[test]
    fn stages_reach_the_shader_as_the_leaf_has_them() {
        let atlas = atlas();
        let forms = LeafMeshes::new(&atlas);
        let form = &atlas.layers[0].form;
        for (number, level) in form.levels.iter().enumerate() {
            let first = forms.meshes[number + 1].first_corner as usize;
            for stage in [0, 2, STAGES] {
                let root = read(&forms, first, stage);
                for corner in [1, level.positions.len() - 1] {
                    let found = read(&forms, first + corner, stage) - root;
                    let place = |corner: usize| {
                        let offset =
                            stage.checked_sub(1).map_or([0.0; 3], |s| level.shapes[s].offsets[corner]);
                        Vec2::from(level.positions[corner]).extend(0.0) + Vec3::from(offset)
                    };
                    let wanted = place(corner) - place(0);
                    let error = (found - wanted).length();
                    assert!(
                        error < 4.0e-4,
                        "level {number}, stage {stage}, corner {corner}: off by {error} sides"
                    );
                }
            }
        }
        assert!(forms.heights[0][STAGES][1] > 0.02, "dry leaves are curled: {:?}", forms.heights[0]);
        assert!(forms.longest.is_sorted(), "levels grow finer: {:?}", forms.longest);
    }

    #[test]
    fn normals_survive_the_octahedron() {
        for n in [Vec3::Z, -Vec3::Z, Vec3::new(0.6, -0.48, 0.64), Vec3::new(-0.6, 0.48, -0.64)] {
            let flat = octahedral(n);
            let z = 1.0 - flat.x.abs() - flat.y.abs();
            let over = (-z).max(0.0);
            let back =
                Vec3::new(flat.x - over * flat.x.signum(), flat.y - over * flat.y.signum(), z).normalize();
            assert!(back.distance(n) < 1.0e-5, "{n} came back as {back}");
        }
    }
}
