// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes a contact sheet of every shape over the season: `contact_sheet OUT.png [SIZE_PX] [SEED] [SHAPE]`.
//!
//! Each shape has a row of leaves from green to brown and below it the same leaves at thumb size. With a shape's
//! index (0 to 5) only that shape is drawn, in several rows.

use std::env;
use std::error::Error;

use image::{Rgba, RgbaImage, imageops};
use windfall_texgen::{Atlas, AtlasEntry, AtlasRequest, Shape};

/// Leaves in a row.
const COLUMNS: u32 = 8;
/// Mip level of the small row: an eighth of the side.
const SMALL: u32 = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let path = arguments.next().ok_or("usage: contact_sheet OUT.png [SIZE_PX] [SEED] [SHAPE]")?;
    let size_px: u32 = arguments.next().map_or(Ok(256), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let shapes: Vec<Shape> = match arguments.next() {
        Some(text) => vec![*Shape::ALL.get(text.parse::<usize>()?).ok_or("shapes are 0 to 7")?; 4],
        None => Shape::ALL.into(),
    };
    let small_px = size_px >> SMALL;
    let row_px = size_px + small_px;
    let rows = u32::try_from(shapes.len())?;
    let mut sheet = RgbaImage::from_pixel(COLUMNS * size_px, rows * row_px, Rgba([236, 234, 228, 255]));
    for (row, &shape) in (0..).zip(&shapes) {
        for column in 0..COLUMNS {
            let season = column as f32 / (COLUMNS - 1) as f32;
            let entries = vec![AtlasEntry { shape, season: (season, season) }];
            let seed = seed.wrapping_mul(1000).wrapping_add(u64::from(row * COLUMNS + column));
            let atlas = Atlas::generate(&AtlasRequest { entries, variants: 1, size_px, seed })?;
            let mips = &atlas.layers[0].mips;
            let (x, y) = (i64::from(column * size_px), i64::from(row * row_px));
            imageops::overlay(&mut sheet, &mips[0], x, y);
            for repeat in 0..3 {
                let level = (SMALL + repeat) as usize;
                let offset = i64::from(repeat * small_px);
                imageops::overlay(&mut sheet, &mips[level], x + offset, y + i64::from(size_px));
            }
        }
    }
    sheet.save(path)?;
    Ok(())
}
