// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Photos above, generated leaves below, all upright and of equal area: for human eyes.

use glam::Vec2;
use image::{Rgb, RgbImage, imageops};

use crate::Specimen;
use crate::math::{floor_i32, lerp, to_byte};

/// Leaves in a row.
const COLUMNS: usize = 8;
/// Side of a cell in pixels.
const CELL: u32 = 256;
/// √A of a leaf in pixels.
const SIDE: f32 = 128.0;
/// Height of the line between photos and generated leaves.
const RULE: u32 = 6;
/// Background.
const PAPER: Rgb<u8> = Rgb([250, 249, 246]);

/// Draws the sheet.
pub fn sheet(photos: &[&Specimen], generated: &[&Specimen]) -> RgbImage {
    let rows = |leaves: &[&Specimen]| u32::try_from(leaves.len().div_ceil(COLUMNS)).unwrap_or(0);
    let columns = u32::try_from(photos.len().max(generated.len()).clamp(1, COLUMNS)).unwrap_or(1);
    let upper = rows(photos) * CELL;
    let mut sheet = RgbImage::from_pixel(columns * CELL, upper + RULE + rows(generated) * CELL, PAPER);
    for y in upper + 1..upper + RULE - 1 {
        for x in 0..sheet.width() {
            sheet.put_pixel(x, y, Rgb([120, 120, 120]));
        }
    }
    for (leaves, top) in [(photos, 0), (generated, upper + RULE)] {
        for (k, leaf) in leaves.iter().enumerate() {
            let place = |cells: usize| i64::try_from(cells).unwrap_or(0) * i64::from(CELL);
            imageops::replace(
                &mut sheet,
                &cell(leaf),
                place(k % COLUMNS),
                i64::from(top) + place(k / COLUMNS),
            );
        }
    }
    sheet
}

/// One leaf without its petiole, turned upright.
fn cell(leaf: &Specimen) -> RgbImage {
    let blade = &leaf.blade;
    let points = &blade.outline;
    let up = (blade.tip - blade.root).try_normalize().unwrap_or(Vec2::NEG_Y);
    let right = Vec2::new(-up.y, up.x);
    let bounds = |direction: Vec2| {
        let reach = || points.iter().map(|p| p.dot(direction));
        (reach().fold(f32::MAX, f32::min), reach().fold(f32::MIN, f32::max))
    };
    let (across, along) = (bounds(right), bounds(up));
    let middle = right * lerp(across.0, across.1, 0.5) + up * lerp(along.0, along.1, 0.5);
    let side = (blade.mask.area() as f32).sqrt().max(1.0);
    let extent = (across.1 - across.0).max(along.1 - along.0);
    let step = (side / SIDE).max(extent / (CELL as f32 * 0.95));
    // Enough samples in each direction that none of a large photo's pixels is skipped.
    let fineness = floor_i32(step).clamp(2, 16);
    RgbImage::from_fn(CELL, CELL, |x, y| {
        let mut sum = [0.0; 3];
        for k in 0..fineness * fineness {
            let sub = Vec2::new((k % fineness) as f32 + 0.5, (k / fineness) as f32 + 0.5) / fineness as f32;
            let at = Vec2::new(x as f32, y as f32) + sub - Vec2::splat(CELL as f32 / 2.0);
            let p = middle + (right * at.x - up * at.y) * step;
            let (column, row) = (floor_i32(p.x), floor_i32(p.y));
            let colour = if blade.mask.contains(column, row) {
                *leaf.picture.get_pixel(column.unsigned_abs(), row.unsigned_abs())
            } else {
                PAPER
            };
            sum.iter_mut().zip(colour.0).for_each(|(sum, channel)| *sum += f32::from(channel) / 255.0);
        }
        Rgb(sum.map(|sum| to_byte(sum / (fineness * fineness) as f32)))
    })
}
