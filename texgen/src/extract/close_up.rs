// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade at a size at which veins are looked for, whatever size its photo has.

use glam::Vec2;

use super::labels::keep_largest;
use super::petiole::depth;
use super::ridge::{Ridges, ridges};
use crate::Mask;
use crate::field::Field;
use crate::math::floor_i32;

/// √A of the close-up in pixels.
const SIDE: f32 = 320.0;
/// Widths of the lines looked for, in √A: those of lateral veins, and twice as wide for main veins.
const SCALES: [f32; 6] = [0.005, 0.007, 0.009, 0.012, 0.017, 0.024];
/// Rim of the blade whose colours are mixed with the background, in √A.
const RIM: f32 = 0.008;
/// Greatest enlargement.
const LARGEST: f32 = 4.0;
/// Longest side of the close-up in pixels; only masks like threads reach it.
const LONGEST: f32 = 1400.0;
/// Pixels left free around the blade.
const BORDER: f32 = 6.0;

/// A blade cut out and scaled, with its lines.
pub(crate) struct CloseUp {
    scale: f32,
    origin: Vec2,
    /// √A in pixels of the close-up.
    pub(crate) side: f32,
    pub(crate) mask: Mask,
    /// Distance of each pixel to the outside.
    pub(crate) depth: Vec<f32>,
    pub(crate) ridges: Ridges,
}

impl CloseUp {
    /// Cuts out a blade that has at least one pixel.
    pub(crate) fn of(lightness: &Field, blade: &Mask) -> Self {
        let width = blade.width as usize;
        let inside = || (0..blade.inside.len()).filter(|i| blade.inside[*i]);
        let place = |i: usize| Vec2::new((i % width) as f32, (i / width) as f32);
        let low = inside().map(place).fold(Vec2::INFINITY, Vec2::min);
        let high = inside().map(place).fold(Vec2::ZERO, Vec2::max) + Vec2::ONE;
        let full_side = (blade.area() as f32).sqrt().max(1.0);
        let scale = (SIDE / full_side).min(LARGEST).min(LONGEST / (high - low).max_element());
        let origin = low - Vec2::splat(BORDER / scale);
        let size = (high - low) * scale + Vec2::splat(2.0 * BORDER);
        let (columns, rows) = (floor_i32(size.x) + 1, floor_i32(size.y) + 1);
        let (columns, rows) = (columns.unsigned_abs(), rows.unsigned_abs());

        // Smoothed before it is made smaller, so that fine texture does not turn into lines.
        let smooth = if scale < 1.0 { lightness.blurred(0.45 / scale) } else { lightness.clone() };
        let mut mask = Mask::empty(columns, rows);
        let mut values = Vec::with_capacity(mask.inside.len());
        for (i, inside) in mask.inside.iter_mut().enumerate() {
            let (x, y) = (i % columns as usize, i / columns as usize);
            let p = origin + Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / scale;
            *inside = blade.contains(floor_i32(p.x), floor_i32(p.y));
            values.push(smooth.sample(p));
        }
        keep_largest(&mut mask, 1);
        let depth = depth(&mask);
        let side = (mask.area() as f32).sqrt().max(1.0);
        let lightness = Field { width: columns as usize, height: rows as usize, values };
        let ridges = ridges(&lightness, &depth, side, (RIM * side).max(1.0), &SCALES);
        Self { scale, origin, side, mask, depth, ridges }
    }

    /// From the photo's pixels to the close-up's.
    pub(crate) fn enter(&self, p: Vec2) -> Vec2 {
        (p - self.origin) * self.scale
    }

    /// From the close-up's pixels to the photo's.
    pub(crate) fn leave(&self, p: Vec2) -> Vec2 {
        p / self.scale + self.origin
    }

    /// A length from the close-up to the photo.
    pub(crate) fn leave_length(&self, length: f32) -> f32 {
        length / self.scale
    }
}
