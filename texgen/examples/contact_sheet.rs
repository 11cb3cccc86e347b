// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints every kind of leaf through its autumn, without any photo: `contact_sheet OUT.png [SIZE_PX] [SEED] [SHAPE]`.
//!
//! A column for each kind, five seasons from green to brown downward, each leaf another one. With a kind's index
//! (0 to 7) only that kind is drawn, in eight columns.

use std::env;
use std::error::Error;

use image::{Rgb, RgbImage, RgbaImage};
use windfall_texgen::{Atlas, AtlasEntry, AtlasRequest, Shape};

/// Seasons shown: fresh, turning, at the height of colour, fading, dry.
const SEASONS: [f32; 5] = [0.0, 0.3, 0.55, 0.75, 1.0];
/// Paper.
const PAPER: Rgb<u8> = Rgb([244, 241, 233]);

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let path = arguments.next().ok_or("usage: contact_sheet OUT.png [SIZE_PX] [SEED] [SHAPE]")?;
    let size_px: u32 = arguments.next().map_or(Ok(256), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let shapes: Vec<Shape> = match arguments.next() {
        Some(text) => vec![*Shape::ALL.get(text.parse::<usize>()?).ok_or("shapes are 0 to 7")?; 8],
        None => Shape::ALL.into(),
    };
    let gap = size_px / 8;
    let pitch = size_px + gap;
    let (columns, rows) = (u32::try_from(shapes.len())?, u32::try_from(SEASONS.len())?);
    let mut sheet = RgbImage::from_pixel(columns * pitch + gap, rows * pitch + gap, PAPER);
    for (column, &shape) in (0..).zip(&shapes) {
        for (row, season) in (0..).zip(SEASONS) {
            let entries = vec![AtlasEntry { shape, season: (season, season) }];
            let seed = seed.wrapping_mul(1000).wrapping_add(u64::from(column * rows + row));
            let atlas = Atlas::generate(&AtlasRequest { entries, variants: 1, size_px, seed })?;
            lay(&mut sheet, &atlas.layers[0].mips[0], (gap + column * pitch, gap + row * pitch));
        }
    }
    sheet.save(path)?;
    Ok(())
}

/// Lays a leaf on the paper with the soft shadow of light from the upper left.
fn lay(sheet: &mut RgbImage, leaf: &RgbaImage, corner: (u32, u32)) {
    let size = leaf.width();
    let reach = (size / 48).max(1);
    let covered = |x: u32, y: u32| {
        if x < size && y < size { u32::from(leaf.get_pixel(x, y)[3]) } else { 0 }
    };
    for y in 0..size + 3 * reach {
        for x in 0..size + 3 * reach {
            // Mean coverage of a square down right of here, as wide as the shadow is soft.
            let (mut sum, mut count) = (0, 0);
            for dy in 0..=reach {
                for dx in 0..=reach {
                    let (from_x, from_y) = (x.wrapping_sub(reach / 2 + dx), y.wrapping_sub(reach / 2 + dy));
                    sum += covered(from_x, from_y);
                    count += 255;
                }
            }
            let shade = 1.0 - 0.3 * sum as f32 / count as f32;
            let [r, g, b, alpha] = if x < size && y < size { leaf.get_pixel(x, y).0 } else { [0; 4] };
            let (px, py) = (corner.0 + x, corner.1 + y);
            if px >= sheet.width() || py >= sheet.height() {
                continue;
            }
            let paper = sheet.get_pixel(px, py).0;
            let share = f32::from(alpha) / 255.0;
            let mix = |leaf: u8, paper: u8| {
                let mixed = f32::from(leaf) * share + f32::from(paper) * shade * (1.0 - share);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "between two bytes"
                )]
                let byte = mixed.round() as u8;
                byte
            };
            sheet.put_pixel(px, py, Rgb([mix(r, paper[0]), mix(g, paper[1]), mix(b, paper[2])]));
        }
    }
}
