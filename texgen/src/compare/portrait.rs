// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade at a normal size, so that leaves from pictures of any size can be compared.

use glam::Vec2;
use image::{RgbImage, imageops};

use crate::distance::{NO_SEED, nearest_seed};
use crate::extract::petiole::depth;
use crate::lab::{self, Lab};
use crate::math::floor_i32;
use crate::{Blade, Mask, Specimen};

/// Rim of the blade whose colours are mixed with the background, in pixels of the photo.
const RIM: f32 = 1.5;

/// A blade scaled to a given √A.
pub(super) struct Portrait {
    pub(super) mask: Mask,
    /// Distance of each pixel to the outside.
    pub(super) depth: Vec<f32>,
    /// Colour of each pixel, continued past the margin.
    pub(super) colours: Vec<Lab>,
    /// √A in pixels.
    pub(super) side: f32,
    /// Unit vector from root to tip.
    pub(super) axis: Vec2,
}

impl Portrait {
    /// Scales a leaf so that √A becomes `side` pixels.
    pub(super) fn of(specimen: &Specimen, side: f32) -> Self {
        let blade = &specimen.blade;
        let (low, high) = bounds(&blade.mask);
        let scale = side / (blade.mask.area() as f32).sqrt().max(1.0);
        let picture = bled(specimen);
        let cut = imageops::crop_imm(&picture, low.0, low.1, high.0 - low.0, high.1 - low.1).to_image();
        let size = |pixels: u32| floor_i32(pixels as f32 * scale + 0.5).clamp(1, 8192).unsigned_abs();
        let (width, height) = (size(cut.width()), size(cut.height()));
        let scaled = imageops::resize(&cut, width, height, imageops::FilterType::Triangle);

        let mut mask = Mask::empty(width + 2, height + 2);
        let mut colours = Vec::with_capacity(mask.inside.len());
        let ratio = Vec2::new(cut.width() as f32 / width as f32, cut.height() as f32 / height as f32);
        for (i, inside) in mask.inside.iter_mut().enumerate() {
            let columns = width as usize + 2;
            let at = Vec2::new((i % columns) as f32 - 0.5, (i / columns) as f32 - 0.5);
            let from = Vec2::new(low.0 as f32, low.1 as f32) + at * ratio;
            *inside = blade.mask.contains(floor_i32(from.x), floor_i32(from.y));
            let (x, y) = (
                floor_i32(at.x).unsigned_abs().min(width - 1),
                floor_i32(at.y).unsigned_abs().min(height - 1),
            );
            colours.push(lab::from_srgb(scaled.get_pixel(x, y).0));
        }
        let depth = depth(&mask);
        Self { mask, depth, colours, side, axis: axis(blade) }
    }

    /// Pixels of the blade at least `least` pixels from its margin; all of them if none is that deep.
    pub(super) fn inner(&self, least: f32) -> Vec<usize> {
        let deep: Vec<usize> = (0..self.depth.len()).filter(|i| self.depth[*i] > least).collect();
        if deep.is_empty() { (0..self.depth.len()).filter(|i| self.mask.inside[*i]).collect() } else { deep }
    }
}

/// Direction of the midrib.
pub(super) fn axis(blade: &Blade) -> Vec2 {
    (blade.tip - blade.root).try_normalize().unwrap_or(Vec2::NEG_Y)
}

/// First and one past the last column and row of a mask.
fn bounds(mask: &Mask) -> ((u32, u32), (u32, u32)) {
    let mut low = (mask.width, mask.height);
    let mut high = (0, 0);
    let places = (0..mask.height).flat_map(|y| (0..mask.width).map(move |x| (x, y)));
    for ((x, y), _) in places.zip(&mask.inside).filter(|(_, inside)| **inside) {
        low = (low.0.min(x), low.1.min(y));
        high = (high.0.max(x + 1), high.1.max(y + 1));
    }
    if high.0 == 0 { ((0, 0), (mask.width, mask.height)) } else { (low, high) }
}

/// The picture with the blade's colours carried over everything else.
fn bled(specimen: &Specimen) -> RgbImage {
    let mask = &specimen.blade.mask;
    let depth = depth(mask);
    let deepest = depth.iter().copied().fold(0.0, f32::max);
    let rim = RIM.min(deepest * 0.5);
    let (_, source) = nearest_seed(mask.width as usize, mask.height as usize, |i| depth[i] > rim);
    let columns = mask.width as usize;
    RgbImage::from_fn(mask.width, mask.height, |x, y| {
        let seed = source.data[y as usize * columns + x as usize];
        // Without any pixel that deep, each keeps its own colour.
        let (x, y) = if seed == NO_SEED { (x, y) } else { (seed % mask.width, seed / mask.width) };
        *specimen.picture.get_pixel(x, y)
    })
}
