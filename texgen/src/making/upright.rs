// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Brings an outline into an upright picture with a petiole below it.

use glam::Vec2;

use crate::raster::{Frame, coverage, stroke};
use crate::rng::Rng;
use crate::{Blade, DrawnLeaf, Mask};

/// Empty border around blade and petiole, as a share of the picture's side.
const BORDER: f32 = 0.016;

/// A blade's margin in leaf coordinates: root at (0, -1), tip at (0, 1), y up, counter-clockwise.
pub(super) fn leaf_coordinates(blade: &Blade) -> Vec<Vec2> {
    let axis = (blade.tip - blade.root) / 2.0;
    let length = axis.length().max(1e-3);
    let up = axis / length;
    let right = Vec2::new(-up.y, up.x);
    let middle = blade.root + axis;
    blade
        .outline
        .iter()
        .map(|p| {
            let offset = (*p - middle) / length;
            Vec2::new(offset.dot(right), offset.dot(up))
        })
        .collect()
}

/// Puts a margin in leaf coordinates, with a petiole below its root at (0, -1), onto a square picture.
pub(super) fn upright(margin: Vec<Vec2>, tip: Vec2, size_px: u32, rng: &mut Rng) -> DrawnLeaf {
    let root = Vec2::NEG_Y;
    let (length, bend) = (rng.range(0.22, 0.5), 0.25 * rng.bell());
    let stalk = |t: f32| {
        let at = root + Vec2::new(bend * length * t * t, -length * t);
        (at, 0.019 * (1.0 + 0.35 * t * t * t))
    };
    const STEPS: u16 = 16;
    let mut petiole: Vec<(Vec2, f32)> =
        (0..=STEPS).rev().map(|i| stalk(f32::from(i) / f32::from(STEPS))).collect();
    petiole.push((root + Vec2::new(0.0, 0.04), 0.016));
    let stem = stroke(&petiole);
    let size = size_px as usize;
    let frame = Frame::around(margin.iter().chain(&stem).copied(), size, BORDER * size_px as f32);
    let inside = coverage(&[&margin], frame).iter().map(|share| *share >= 0.5).collect();
    let blade = Blade {
        mask: Mask { width: size_px, height: size_px, inside },
        outline: margin.iter().map(|p| frame.to_texel(*p)).collect(),
        root: frame.to_texel(root),
        tip: frame.to_texel(tip),
        confidence: 1.0,
    };
    let petiole = petiole.iter().map(|(p, radius)| (frame.to_texel(*p), radius * frame.scale)).collect();
    DrawnLeaf { blade, petiole }
}
