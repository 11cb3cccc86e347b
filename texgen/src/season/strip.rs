// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One leaf from green to brown, side by side.

use image::{Rgb, RgbImage};

use crate::paint::{Leaf, paint};
use crate::rng::Rng;
use crate::{Shape, TexgenError};

/// Paints one leaf at evenly spaced seasons from 0 to 1, left to right, each `size_px` square on white paper.
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
    let mut sheet = RgbImage::from_pixel(steps * size_px, size_px, Rgb([255; 3]));
    for step in 0..steps {
        let season = step as f32 / (steps - 1) as f32;
        let picture = paint(&Leaf { shape, season, size_px }, &Rng::new(seed));
        for (x, y, texel) in picture.enumerate_pixels() {
            let [r, g, b, alpha] = texel.0.map(f32::from);
            let over = |c: f32| crate::math::to_byte((255.0 + (c - 255.0) * alpha / 255.0) / 255.0);
            sheet.put_pixel(step * size_px + x, y, Rgb([over(r), over(g), over(b)]));
        }
    }
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_turns_from_green_to_brown() {
        let sheet = strip(Shape::Birch, 4, 64, 3).expect("the numbers are allowed");
        assert_eq!(sheet.dimensions(), (256, 64), "four leaves of 64 pixels");
        let mean = |step: u32| {
            let mut sum = [0_u32; 3];
            for (x, _, pixel) in sheet.enumerate_pixels() {
                if x / 64 == step && pixel.0 != [255; 3] {
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
