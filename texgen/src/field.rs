// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One number for each pixel of a picture.

use glam::Vec2;

use crate::math::floor_i32;

/// A grid of numbers, row after row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f32>,
}

impl Field {
    /// The same number everywhere.
    pub(crate) fn constant(width: usize, height: usize, value: f32) -> Self {
        Self { width, height, values: vec![value; width * height] }
    }

    /// Value at a pixel, or at the nearest one on the grid.
    pub(crate) fn at(&self, x: i32, y: i32) -> f32 {
        let (x, y) = (clamp_index(x, self.width), clamp_index(y, self.height));
        self.values[y * self.width + x]
    }

    /// Bilinear value at a point; the centre of the first pixel is (0.5, 0.5).
    pub(crate) fn sample(&self, p: Vec2) -> f32 {
        let corner = p - Vec2::splat(0.5);
        let (x, y) = (floor_i32(corner.x), floor_i32(corner.y));
        let (u, v) = (corner.x - x as f32, corner.y - y as f32);
        let above = self.at(x, y) * (1.0 - u) + self.at(x.saturating_add(1), y) * u;
        let y = y.saturating_add(1);
        let below = self.at(x, y) * (1.0 - u) + self.at(x.saturating_add(1), y) * u;
        above * (1.0 - v) + below * v
    }

    /// Convolved with a Gaussian of `sigma` pixels; the border is repeated outward.
    pub(crate) fn blurred(&self, sigma: f32) -> Self {
        let kernel = gaussian(sigma);
        self.convolved_rows(&kernel).transposed().convolved_rows(&kernel).transposed()
    }

    /// Rows and columns exchanged.
    fn transposed(&self) -> Self {
        let mut values = Vec::with_capacity(self.values.len());
        for x in 0..self.width {
            values.extend((0..self.height).map(|y| self.values[y * self.width + x]));
        }
        Self { width: self.height, height: self.width, values }
    }

    /// Each row convolved with a symmetric kernel given from its centre outward.
    fn convolved_rows(&self, half_kernel: &[f32]) -> Self {
        let reach = half_kernel.len() - 1;
        let mut values = Vec::with_capacity(self.values.len());
        let mut padded = vec![0.0; self.width + 2 * reach];
        for row in self.values.chunks_exact(self.width.max(1)) {
            padded[..reach].fill(row[0]);
            padded[reach..reach + row.len()].copy_from_slice(row);
            padded[reach + row.len()..].fill(row[row.len() - 1]);
            values.extend((reach..reach + row.len()).map(|centre| {
                let sides = (1..=reach).map(|k| half_kernel[k] * (padded[centre - k] + padded[centre + k]));
                half_kernel[0] * padded[centre] + sides.sum::<f32>()
            }));
        }
        Self { values, ..*self }
    }
}

/// Nearest valid index.
fn clamp_index(i: i32, count: usize) -> usize {
    usize::try_from(i).unwrap_or(0).min(count.saturating_sub(1))
}

/// Gaussian weights from the centre to three deviations out, their full sum being 1.
fn gaussian(sigma: f32) -> Vec<f32> {
    let sigma = sigma.max(1e-3);
    let reach = usize::try_from(floor_i32((3.0 * sigma).min(1e4)) + 1).unwrap_or(1);
    let mut half: Vec<f32> =
        (0..=reach).map(|k| libm::expf(-((k * k) as f32) / (2.0 * sigma * sigma))).collect();
    let sum = 2.0 * half.iter().sum::<f32>() - half[0];
    half.iter_mut().for_each(|weight| *weight /= sum);
    half
}

/// The value below which a share of the numbers lies; 0 if there are none.
pub(crate) fn quantile(values: &mut [f32], share: f32) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let last = values.len() - 1;
    let rank = usize::try_from(floor_i32(share * last as f32)).unwrap_or(0).min(last);
    *values.select_nth_unstable_by(rank, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blur_keeps_the_sum_and_spreads() {
        let mut field = Field::constant(21, 21, 0.0);
        field.values[10 * 21 + 10] = 1.0;
        let blurred = field.blurred(1.5);
        let sum: f32 = blurred.values.iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "nothing gets lost inside the grid, sum {sum}");
        let expected = 1.0 / (std::f32::consts::TAU * 1.5 * 1.5);
        assert!(
            (blurred.at(10, 10) - expected).abs() < 0.003,
            "height of a Gaussian: {}",
            blurred.at(10, 10)
        );
    }

    #[test]
    fn samples_at_pixel_centres_are_the_pixels() {
        let field = Field { width: 3, height: 2, values: vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0] };
        assert_eq!(field.sample(Vec2::new(1.5, 1.5)), 4.0, "centre of a pixel");
        assert_eq!(field.sample(Vec2::new(2.0, 1.0)), 3.0, "between four pixels");
        assert_eq!(field.sample(Vec2::new(-9.0, 99.0)), 3.0, "off the grid the border goes on");
    }

    #[test]
    fn quantiles_of_a_ramp() {
        let mut ramp: Vec<f32> = (0..101).map(|i| i as f32).collect();
        assert_eq!(quantile(&mut ramp, 0.9), 90.0, "ninetieth of a hundred");
        assert_eq!(quantile(&mut [], 0.5), 0.0, "nothing to rank");
    }
}
