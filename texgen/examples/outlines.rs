// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws outlines learned from photos: `outlines OUT.png PHOTO…`; the top row holds the examples.

use std::env;
use std::error::Error;
use std::path::{Path, PathBuf};

use image::{GrayImage, Luma};
use windfall_texgen::{Blade, OutlineModel, Specimen};

/// Side of a cell.
const CELL: u32 = 260;
/// Drawn leaves.
const COUNT: u32 = 16;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args_os().skip(1).map(PathBuf::from);
    let out = arguments.next().ok_or("usage: outlines OUT.png PHOTO…")?;
    let mut blades = Vec::new();
    for path in arguments {
        let beside = path.with_extension("mask.png");
        let mask: Option<&Path> = if beside.exists() { Some(&beside) } else { None };
        blades.push(Specimen::from_photo(&path, mask)?.blade);
    }
    let model = OutlineModel::from_blades(&blades)?;
    let mut sheet = GrayImage::from_pixel(8 * CELL, 3 * CELL, Luma([255]));
    let mut put = |cell: u32, blade: &Blade| {
        let longest = blade.mask.width.max(blade.mask.height);
        for y in 0..CELL {
            for x in 0..CELL {
                let from = |at: u32| i32::try_from(at * longest / CELL).unwrap_or(-1);
                if blade.mask.contains(from(x), from(y)) {
                    sheet.put_pixel(cell % 8 * CELL + x, cell / 8 * CELL + y, Luma([60]));
                }
            }
        }
    };
    for (cell, blade) in (0..8).zip(&blades) {
        put(cell, blade);
    }
    for seed in 0..COUNT {
        put(8 + seed, &model.draw(CELL, u64::from(seed))?.blade);
    }
    sheet.save(out)?;
    Ok(())
}
