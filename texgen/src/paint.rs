// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints one leaf.

mod canvas;
pub(crate) mod specimen;
mod tissue;

use image::RgbaImage;

use crate::Shape;
use crate::contour::Outline;
use crate::math::{srgb_from_linear, to_byte};
use crate::rng::Rng;
use crate::veins;
use crate::warp::Warp;
use canvas::Canvas;
use tissue::Tissue;

/// A leaf to paint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf {
    /// Outline family.
    pub(crate) shape: Shape,
    /// Season from 0 (green) to 1 (brown).
    pub(crate) season: f32,
    /// Side of the image in texels.
    pub(crate) size_px: u32,
}

/// Paints a leaf on a transparent ground.
pub(crate) fn paint(leaf: &Leaf, rng: &Rng) -> RgbaImage {
    let mut outline = Outline::draw(leaf.shape, &rng.fork(10));
    let mut veins = veins::grow(leaf.shape, &outline, &rng.fork(11));
    let warp = Warp::draw(&mut rng.fork(12));
    for p in outline.blade.iter_mut().chain(outline.petiole.iter_mut().map(|(p, _)| p)) {
        *p = warp.apply(*p);
    }
    for p in veins.iter_mut().flat_map(|vein| &mut vein.points) {
        *p = warp.apply(*p);
    }
    let canvas = Canvas::new(&outline, &veins, leaf.size_px as usize, leaf.season, &mut rng.fork(13));
    let tissue = Tissue::draw(leaf, &mut rng.fork(14));
    let stride = leaf.size_px as usize;
    RgbaImage::from_fn(leaf.size_px, leaf.size_px, |x, y| {
        let index = y as usize * stride + x as usize;
        let alpha = to_byte(canvas.coverage[index]);
        if alpha == 0 {
            return image::Rgba([0; 4]);
        }
        let [r, g, b] = tissue.colour(&canvas.spot(index));
        image::Rgba([srgb_from_linear(r), srgb_from_linear(g), srgb_from_linear(b), alpha])
    })
}
