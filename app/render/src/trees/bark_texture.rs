// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints bark: a tile of colour, height and grooves for every kind, which repeats without a seam.

use std::sync::OnceLock;

use glam::{Vec2, Vec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::BarkKind;
use crate::random::Random;

/// Edge of a tile in texels; it covers `windfall_core::tree::bark::BARK_TILE_M` metres both ways.
pub const BARK_SIZE: usize = 256;
const EDGE: f32 = BARK_SIZE as f32;

/// One kind of bark: two images of `BARK_SIZE` squared, with their halvings. Rows run up the trunk.
pub struct Bark {
    /// Square root of the colour; height from 0 in the grooves to 1.
    pub surface: Vec<Vec<u8>>,
    /// Tilt of the surface around and along the limb, 0.5 for none; open sky; scar where the bark has cracked for good.
    pub relief: Vec<Vec<u8>>,
}

/// Colour, height and scar of a place, which has coordinates from 0 to 1.
struct Texel {
    color: Vec3,
    height: f32,
    scar: f32,
}

/// All kinds of bark in the order of [`BarkKind::ALL`], painted once for all renderers.
pub(crate) fn painted_barks() -> &'static [Bark] {
    static BARKS: OnceLock<Vec<Bark>> = OnceLock::new();
    if BARKS.get().is_none() {
        // Outside of the lock, as other threads help; another renderer may have been faster.
        let _ = BARKS.set(BarkKind::ALL.into_par_iter().map(paint_bark).collect());
    }
    BARKS.get().map_or(&[], Vec::as_slice)
}

/// Paints a kind of bark.
pub fn paint_bark(kind: BarkKind) -> Bark {
    let (paint, depth): (fn(&Field, Vec2) -> Texel, f32) = match kind {
        BarkKind::Maple => (maple, 2.2),
        BarkKind::Birch => (birch, 1.2),
        BarkKind::Oak => (oak, 6.0),
        BarkKind::Shrub => (shrub, 0.9),
        BarkKind::Herb => (herb, 1.5),
    };
    let field = Field::new(311 + kind as u32);
    let texels: Vec<Texel> = (0..BARK_SIZE * BARK_SIZE)
        .map(|index| {
            let at = Vec2::new((index % BARK_SIZE) as f32 + 0.5, (index / BARK_SIZE) as f32 + 0.5);
            paint(&field, at / EDGE)
        })
        .collect();
    let height = |x: usize, y: usize| texels[(y % BARK_SIZE) * BARK_SIZE + x % BARK_SIZE].height;
    let planes: Vec<[f32; 8]> = (0..texels.len())
        .map(|index| {
            let (x, y) = (index % BARK_SIZE, index / BARK_SIZE);
            let before = BARK_SIZE - 1;
            let slope =
                Vec2::new(height(x + before, y) - height(x + 1, y), height(x, y + before) - height(x, y + 1))
                    * depth;
            let tilt = slope / (1.0 + slope.length_squared()).sqrt();
            // Lower than what is around it: in the shade of the ridges.
            let around: f32 = [(5, 0), (before - 4, 0), (0, 5), (0, before - 4), (11, 0), (before - 10, 0)]
                .iter()
                .map(|&(dx, dy)| height(x + dx, y + dy))
                .sum::<f32>()
                / 6.0;
            let texel = &texels[index];
            let open = (1.0 - 0.25 * depth * (around - texel.height).max(0.0)).clamp(0.25, 1.0);
            let root = |channel: f32| channel.max(0.0).sqrt();
            let color = texel.color;
            let halved = 0.5 + 0.5 * tilt;
            [root(color.x), root(color.y), root(color.z), texel.height, halved.x, halved.y, open, texel.scar]
        })
        .collect();
    mips(planes)
}

/// Halves the planes down to one texel.
fn mips(mut planes: Vec<[f32; 8]>) -> Bark {
    let mut bark = Bark { surface: Vec::new(), relief: Vec::new() };
    let mut size = BARK_SIZE;
    loop {
        let bytes = |range: std::ops::Range<usize>| {
            planes.iter().flat_map(move |p| p[range.clone()].to_vec()).map(byte)
        };
        bark.surface.push(bytes(0..4).collect());
        bark.relief.push(bytes(4..8).collect());
        if size == 1 {
            return bark;
        }
        let half = size / 2;
        let texel = |x: usize, y: usize| &planes[y * size + x];
        planes = (0..half * half)
            .map(|index| {
                let (x, y) = (2 * (index % half), 2 * (index / half));
                let four = [texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1)];
                std::array::from_fn(|plane| four.iter().map(|texel| texel[plane]).sum::<f32>() * 0.25)
            })
            .collect();
        size = half;
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a byte")]
fn byte(value: f32) -> u8 {
    (value * 255.0 + 0.5).clamp(0.0, 255.0) as u8
}

/// Noise that repeats with the tile.
struct Field {
    values: Vec<f32>,
}

/// Edge of the lattice of random values.
const LATTICE: usize = 64;

impl Field {
    fn new(seed: u32) -> Self {
        let mut random = Random::new(seed);
        Self { values: (0..LATTICE * LATTICE).map(|_| random.unit()).collect() }
    }

    /// Random value of a cell of a lattice of `cells`, the `layer`th.
    fn cell(&self, x: i32, y: i32, cells: (i32, i32), layer: i32) -> f32 {
        let (x, y) = (x.rem_euclid(cells.0), y.rem_euclid(cells.1));
        let edge = i32::try_from(LATTICE).unwrap_or(1);
        let index =
            (y * 29 + layer * 13).rem_euclid(edge) * edge + (x * 37 + layer * 17 + y / edge).rem_euclid(edge);
        self.values[usize::try_from(index).unwrap_or(0)]
    }

    /// Smooth noise from 0 to 1 with `cells` around and along.
    fn smooth(&self, at: Vec2, cells: (i32, i32), layer: i32) -> f32 {
        let at = at * Vec2::new(cells.0 as f32, cells.1 as f32);
        let (low, part) = (at.floor(), at - at.floor());
        let ease = part * part * (Vec2::splat(3.0) - 2.0 * part);
        let (x, y) = whole(low);
        let value = |dx, dy| self.cell(x + dx, y + dy, cells, layer);
        let top = value(0, 0) + ease.x * (value(1, 0) - value(0, 0));
        let bottom = value(0, 1) + ease.x * (value(1, 1) - value(0, 1));
        top + ease.y * (bottom - top)
    }

    /// Sum of octaves, about 0 to 1.
    fn fractal(&self, at: Vec2, cells: (i32, i32), octaves: i32, layer: i32) -> f32 {
        let mut sum = 0.0;
        let mut weight = 0.5;
        for octave in 0..octaves {
            let finer = (cells.0 << octave, cells.1 << octave);
            sum += weight * self.smooth(at, finer, layer + octave);
            weight *= 0.5;
        }
        sum / (1.0 - 2.0 * weight)
    }

    /// Distances to the nearest and second nearest of one point in each cell, in cells.
    fn cracks(&self, at: Vec2, cells: (i32, i32), layer: i32) -> (f32, f32, f32) {
        let at = at * Vec2::new(cells.0 as f32, cells.1 as f32);
        let (x, y) = whole(at.floor());
        let (mut first, mut second, mut own) = (9.0f32, 9.0f32, 0.0);
        for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
            let (cx, cy) = (x + dx, y + dy);
            let point = Vec2::new(
                cx as f32 + 0.15 + 0.7 * self.cell(cx, cy, cells, layer),
                cy as f32 + 0.15 + 0.7 * self.cell(cx, cy, cells, layer + 1),
            );
            let distance = point.distance(at);
            if distance < first {
                (first, second, own) = (distance, first, self.cell(cx, cy, cells, layer + 2));
            } else {
                second = second.min(distance);
            }
        }
        (first, second, own)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "cells of a tile")]
fn whole(at: Vec2) -> (i32, i32) {
    (at.x as i32, at.y as i32)
}

fn step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Long plates between furrows: the height of their crests, 1, down to 0 in the furrows.
fn plates(field: &Field, at: Vec2, cells: (i32, i32), wander: f32, layer: i32) -> (f32, f32) {
    let aside = field.fractal(at, (4, 4), 3, layer + 20) - 0.5;
    let (first, second, own) =
        field.cracks(at + Vec2::new(wander * aside, 0.5 * wander * aside), cells, layer);
    (second - first, own)
}

fn maple(field: &Field, at: Vec2) -> Texel {
    let (gap, own) = plates(field, at, (17, 3), 0.15, 1);
    let grain = field.fractal(at, (24, 10), 3, 5);
    let height = step(0.02, 0.32, gap) * (0.72 + 0.2 * own) + 0.28 * (grain - 0.5) + 0.05;
    let patch = field.fractal(at, (3, 3), 3, 9);
    let crest = Vec3::new(0.205, 0.180, 0.150).lerp(Vec3::new(0.165, 0.150, 0.115), own);
    let crest = crest.lerp(Vec3::new(0.190, 0.205, 0.150), 0.6 * step(0.52, 0.75, patch));
    let color = Vec3::new(0.082, 0.066, 0.052).lerp(crest, step(0.05, 0.75, height)) * (0.72 + 0.56 * grain);
    Texel { color, height: height.clamp(0.0, 1.0), scar: 0.0 }
}

fn oak(field: &Field, at: Vec2) -> Texel {
    let (gap, own) = plates(field, at, (9, 2), 0.26, 2);
    let grain = field.fractal(at, (32, 12), 3, 6);
    let across = field.fractal(at, (6, 22), 2, 11);
    let crest = step(0.03, 0.40, gap) * (0.8 + 0.2 * own);
    // Old plates break across.
    let height = crest * (1.0 - 0.35 * step(0.58, 0.66, across)) + 0.40 * (grain - 0.5);
    let patch = field.fractal(at, (3, 3), 3, 9);
    let ridge = Vec3::new(0.165, 0.138, 0.108).lerp(Vec3::new(0.125, 0.100, 0.075), own);
    let ridge = ridge.lerp(Vec3::new(0.150, 0.165, 0.110), 0.5 * step(0.5, 0.75, patch));
    let color = Vec3::new(0.022, 0.016, 0.012).lerp(ridge, step(0.0, 0.8, height)) * (0.7 + 0.6 * grain);
    Texel { color, height: height.clamp(0.0, 1.0), scar: 0.0 }
}

fn birch(field: &Field, at: Vec2) -> Texel {
    let grain = field.fractal(at, (4, 32), 3, 3);
    let cloud = field.fractal(at, (3, 4), 3, 7);
    let mut color = Vec3::new(0.66, 0.63, 0.57).lerp(Vec3::new(0.50, 0.44, 0.37), step(0.45, 0.8, cloud));
    color *= 0.85 + 0.3 * grain;
    let mut height = 0.7 + 0.2 * (grain - 0.5);
    // Lenticels: dark dashes across, of all lengths; a cell of each layer may hold one.
    for (layer, cells, long, chance) in
        [(30, (3, 14), 0.36, 0.45), (34, (6, 22), 0.34, 0.5), (38, (12, 30), 0.3, 0.4)]
    {
        let place = at * Vec2::new(cells.0 as f32, cells.1 as f32);
        let (x, y) = whole(place.floor());
        let random = |offset| field.cell(x, y, cells, layer + offset);
        if random(0) > chance {
            continue;
        }
        let half = long * (0.4 + 0.6 * random(1));
        let middle = Vec2::new(0.5 + (0.5 - half) * (2.0 * random(2) - 1.0), 0.3 + 0.4 * random(3));
        let from = (place - place.floor() - middle) / Vec2::new(half, 0.13 + 0.12 * random(1));
        let dark = 1.0 - step(0.55, 1.0, from.length());
        color = color.lerp(Vec3::new(0.060, 0.045, 0.038), 0.9 * dark);
        height -= 0.35 * dark;
    }
    // Black rough diamonds where the white has cracked; which of them show, every tree decides.
    let crack = field.fractal(at, (4, 3), 4, 12);
    let rough = step(0.60, 0.66, crack);
    Texel { color, height: height.clamp(0.0, 1.0), scar: rough * (0.6 + 0.4 * grain) }
}

fn shrub(field: &Field, at: Vec2) -> Texel {
    let grain = field.fractal(at, (8, 6), 4, 4);
    let mut color =
        Vec3::new(0.115, 0.095, 0.055).lerp(Vec3::new(0.095, 0.110, 0.050), step(0.4, 0.7, grain));
    let mut height = 0.5 + 0.4 * (grain - 0.5);
    let (first, _, own) = field.cracks(at, (12, 10), 14);
    let spot = (1.0 - step(0.08, 0.16, first)) * step(0.3, 0.35, own);
    color = color.lerp(Vec3::new(0.30, 0.25, 0.17), 0.8 * spot);
    height += 0.3 * spot;
    Texel { color, height: height.clamp(0.0, 1.0), scar: 0.0 }
}

fn herb(field: &Field, at: Vec2) -> Texel {
    let rib = 0.5 + 0.5 * (at.x * std::f32::consts::TAU * 12.0).cos();
    let grain = field.fractal(at, (6, 12), 3, 4);
    let color = Vec3::new(0.075, 0.125, 0.030).lerp(Vec3::new(0.150, 0.190, 0.055), 0.6 * rib + 0.3 * grain);
    let color = color.lerp(Vec3::new(0.16, 0.07, 0.045), 0.5 * step(0.55, 0.75, grain));
    Texel { color, height: (0.6 * rib + 0.4 * grain).clamp(0.0, 1.0), scar: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_repeat_without_a_seam() {
        for kind in BarkKind::ALL {
            let bark = paint_bark(kind);
            let image = &bark.surface[0];
            let texel = |x: usize, y: usize| f32::from(image[4 * (y * BARK_SIZE + x) + 1]);
            let last = BARK_SIZE - 1;
            let rows = 0..BARK_SIZE;
            let across: f32 = rows.clone().map(|y| (texel(last, y) - texel(0, y)).abs()).sum();
            let within: f32 = rows.clone().map(|y| (texel(100, y) - texel(101, y)).abs()).sum();
            assert!(
                across < 2.0 * within + 600.0,
                "{kind:?} around: {across} at the seam, {within} elsewhere"
            );
            let along: f32 = rows.clone().map(|x| (texel(x, last) - texel(x, 0)).abs()).sum();
            let within: f32 = rows.map(|x| (texel(x, 100) - texel(x, 101)).abs()).sum();
            assert!(along < 2.0 * within + 600.0, "{kind:?} along: {along} at the seam, {within} elsewhere");
        }
    }

    #[test]
    fn birch_is_white_and_oak_is_rough() {
        let mean = |kind: BarkKind, channel: usize| {
            let last = paint_bark(kind).surface.pop().expect("mips");
            f32::from(last[channel]) / 255.0
        };
        assert!(mean(BarkKind::Birch, 1) > 0.55, "birch {}", mean(BarkKind::Birch, 1));
        assert!(mean(BarkKind::Oak, 1) < 0.45, "oak {}", mean(BarkKind::Oak, 1));
        let open = |kind: BarkKind| paint_bark(kind).relief.pop().expect("mips")[2];
        assert!(open(BarkKind::Oak) < open(BarkKind::Shrub), "furrows see less of the sky");
    }
}
