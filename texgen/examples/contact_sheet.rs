// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes every kind of leaf through its autumn, without any photo: `contact_sheet OUT.png [LEAF_PX] [SEED]`.
//!
//! A column for each kind, five seasons from green to brown downward, each leaf another one.

use std::env;
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage, RgbaImage, imageops};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use windfall_texgen::{Layer, LeafMaker, MakeOptions, Shape};

/// Seasons shown: fresh, turning, at the height of colour, fading, dry.
const SEASONS: [f32; 5] = [0.0, 0.28, 0.55, 0.76, 1.0];
/// Paper.
const PAPER: Rgb<u8> = Rgb([246, 244, 238]);
/// Edge of the pictures that leaves are made in before they are scaled to the sheet.
const MADE_PX: u32 = 512;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let path = arguments.next().ok_or("usage: contact_sheet OUT.png [LEAF_PX] [SEED]")?;
    let leaf_px: u32 = arguments.next().map_or(Ok(196), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let gap = leaf_px / 10;
    let pitch = leaf_px + gap;
    let (columns, rows) = (u32::try_from(Shape::ALL.len())?, u32::try_from(SEASONS.len())?);
    let mut sheet = RgbImage::from_pixel(columns * pitch + gap, rows * pitch + gap, PAPER);
    let places: Vec<(u32, u32)> =
        (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))).collect();
    let make = |(column, row): (u32, u32)| -> Result<_, windfall_texgen::TexgenError> {
        let season = Some(SEASONS[row as usize]);
        let maker =
            LeafMaker::of_shape(Shape::ALL[column as usize], MakeOptions { size_px: MADE_PX, season, seed })?;
        let made = Layer::from_picture(maker.make(row, false)?.maps.albedo);
        let halved = made.mips.iter().rev().find(|mip| mip.width() >= leaf_px).unwrap_or(&made.mips[0]);
        Ok((column, row, imageops::resize(halved, leaf_px, leaf_px, imageops::FilterType::CatmullRom)))
    };
    let leaves: Vec<_> = places.into_par_iter().map(make).collect::<Result<_, _>>()?;
    for (column, row, leaf) in leaves {
        lay(&mut sheet, &leaf, (gap + column * pitch, gap + row * pitch));
    }
    let file = BufWriter::new(File::create(path)?);
    sheet.write_with_encoder(PngEncoder::new_with_quality(
        file,
        CompressionType::Best,
        FilterType::Adaptive,
    ))?;
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
