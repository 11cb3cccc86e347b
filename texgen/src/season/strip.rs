// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One leaf from green to brown, side by side.

use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage, RgbaImage};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::math::to_byte;
use crate::{LeafMaker, MakeOptions, Shape, TexgenError};

/// Makes one leaf at evenly spaced seasons from 0 to 1, left to right, each `size_px` square on white paper.
/// Equal arguments give equal bytes.
///
/// # Errors
/// [`TexgenError::OutOfRange`] unless there are 2 to 64 steps of 16 to 2048 pixels, and at most 32768 pixels across.
pub fn strip(shape: Shape, steps: u32, size_px: u32, seed: u64) -> Result<RgbImage, TexgenError> {
    if !(2..=64).contains(&steps) {
        return Err(TexgenError::out_of_range("steps", steps, "2 to 64"));
    }
    if !(16..=2048).contains(&size_px) {
        return Err(TexgenError::out_of_range("size", size_px, "16 to 2048"));
    }
    if steps * size_px > 32_768 {
        return Err(TexgenError::out_of_range("steps times size", steps * size_px, "at most 32768"));
    }
    let leaf = |step: u32| {
        let season = step as f32 / (steps - 1) as f32;
        let options =
            MakeOptions { size_px: size_px.next_power_of_two().max(64), season: Some(season), seed };
        let leaf = LeafMaker::of_shape(shape, options)?.make(0, false)?;
        Ok(imageops::resize(&on_paper(&leaf.maps.albedo), size_px, size_px, FilterType::Triangle))
    };
    let leaves = (0..steps).into_par_iter().map(leaf).collect::<Result<Vec<RgbImage>, TexgenError>>()?;
    let mut sheet = RgbImage::new(steps * size_px, size_px);
    for (leaf, step) in leaves.iter().zip(0..) {
        imageops::replace(&mut sheet, leaf, step * i64::from(size_px), 0);
    }
    Ok(sheet)
}

/// A picture on white paper.
fn on_paper(picture: &RgbaImage) -> RgbImage {
    RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let [r, g, b, alpha] = picture.get_pixel(x, y).0.map(f32::from);
        Rgb([r, g, b].map(|c| to_byte((255.0 + (c - 255.0) * alpha / 255.0) / 255.0)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_turns_from_green_to_brown() {
        let sheet = strip(Shape::Birch, 4, 60, 3).expect("the numbers are allowed");
        assert_eq!(sheet.dimensions(), (240, 60), "four leaves of 60 pixels");
        let mean = |step: u32| {
            let mut sum = [0_u32; 3];
            for (x, _, pixel) in sheet.enumerate_pixels() {
                if x / 60 == step && pixel.0 != [255; 3] {
                    for (sum, c) in sum.iter_mut().zip(pixel.0) {
                        *sum += u32::from(c);
                    }
                }
            }
            sum
        };
        let (first, last) = (mean(0), mean(3));
        assert!(first[1] > first[0], "the first leaf is green: {first:?}");
        assert!(last[0] > last[1] && last[1] > last[2], "the last leaf is brown: {last:?}");
        assert!(strip(Shape::Oak, 1, 64, 3).is_err(), "one step is no strip");
    }
}
