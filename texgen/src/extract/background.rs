// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf's mask from a photo on a plain background.
//!
//! The background's colour may change slowly across the picture, as under a lamp: a plane per Lab channel is
//! fitted to the picture's edge. What differs from it is leaf. Shadows differ in lightness more than in hue, so
//! darkening counts less than a change of hue does.

use image::RgbImage;

use crate::Mask;
use crate::field::{Field, quantile};
use crate::lab::{self, Lab};
use crate::math::floor_i32;

/// The shorter side by this is the width of the picture's edge.
const EDGE: usize = 50;
/// Smallest difference in Lab units between leaf and background.
const LEAST: f32 = 6.0;
/// Threshold as a share of the best split: pale parts of a leaf differ less from paper than its bulk does.
const CLOSENESS: f32 = 0.6;
/// Weight of the lightness difference where hue agrees.
const LIGHTNESS: f32 = 0.45;
/// Levels of the histogram whose best split is the threshold, one per Lab unit.
const LEVELS: usize = 128;

/// Finds what stands out from the background; `None` if nothing does.
pub(super) fn leaf_mask(picture: &RgbImage) -> Option<Mask> {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let colours: Vec<Lab> = picture.pixels().map(|pixel| lab::from_srgb(pixel.0)).collect();
    let place = |i: usize| {
        let (x, y) = ((i % width) as f32 / width as f32, (i / width) as f32 / height as f32);
        [1.0, f64::from(x) - 0.5, f64::from(y) - 0.5]
    };
    let margin = width.min(height).div_ceil(EDGE);
    let is_edge = |i: &usize| {
        let (x, y) = (i % width, i / width);
        x.min(y).min(width - 1 - x).min(height - 1 - y) < margin
    };
    let edge: Vec<usize> = (0..width * height).filter(is_edge).collect();
    let planes = fit(&edge, &colours, place)?;
    let differs = |i: usize| {
        let at = place(i);
        let [dl, da, db] = std::array::from_fn(|c| {
            #[expect(clippy::cast_possible_truncation, reason = "a colour")]
            let background = at.iter().zip(&planes[c]).map(|(p, k)| p * k).sum::<f64>() as f32;
            colours[i][c] - background
        });
        (dl * dl * LIGHTNESS * LIGHTNESS + da * da + db * db).sqrt()
    };
    let difference = Field { width, height, values: (0..width * height).map(differs).collect() };
    let mut at_edge: Vec<f32> = edge.iter().map(|i| difference.values[*i]).collect();
    let noise = quantile(&mut at_edge, 0.9);
    let threshold = (best_split(&difference.values)? * CLOSENESS).max(LEAST).max(1.5 * noise);
    let inside: Vec<bool> = difference.values.iter().map(|d| *d > threshold).collect();
    let (width, height) = (picture.width(), picture.height());
    inside.contains(&true).then_some(Mask { width, height, inside })
}

/// Fits a plane per channel to the edge, then once more without the third that fits worst (a leaf's tip may reach
/// the edge).
fn fit(edge: &[usize], colours: &[Lab], place: impl Fn(usize) -> [f64; 3]) -> Option<[[f64; 3]; 3]> {
    let planes = |edge: &[usize]| -> Option<[[f64; 3]; 3]> {
        let mut fitted = [[0.0; 3]; 3];
        for (channel, plane) in fitted.iter_mut().enumerate() {
            *plane = least_squares(edge.iter().map(|i| (place(*i), f64::from(colours[*i][channel]))))?;
        }
        Some(fitted)
    };
    let first = planes(edge)?;
    let miss = |i: usize| -> f64 {
        let at = place(i);
        let channel = |c: usize| {
            let background: f64 = at.iter().zip(&first[c]).map(|(p, k)| p * k).sum();
            (f64::from(colours[i][c]) - background).abs()
        };
        channel(0) + channel(1) + channel(2)
    };
    let mut sorted = edge.to_vec();
    sorted.sort_by(|a, b| miss(*a).total_cmp(&miss(*b)));
    sorted.truncate((sorted.len() * 2).div_ceil(3));
    planes(&sorted).or(Some(first))
}

/// Coefficients that fit `value = Σ coefficient · term` best; `None` if the terms do not determine them.
fn least_squares(samples: impl Iterator<Item = ([f64; 3], f64)>) -> Option<[f64; 3]> {
    let mut rows = [[0.0; 4]; 3];
    for (terms, value) in samples {
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, term) in terms.iter().enumerate() {
                row[j] += terms[i] * term;
            }
            row[3] += terms[i] * value;
        }
    }
    for i in 0..3 {
        // A little ridge keeps one-pixel-wide pictures solvable.
        rows[i][i] += 1e-6;
        let pivot = rows[i];
        for (j, row) in rows.iter_mut().enumerate() {
            if j != i {
                let share = row[i] / pivot[i];
                row.iter_mut().zip(&pivot).for_each(|(a, b)| *a -= share * b);
            }
        }
    }
    let solution: [f64; 3] = std::array::from_fn(|i| rows[i][3] / rows[i][i]);
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// Otsu's threshold: the split of the values into two classes that lie farthest apart.
///
/// # Source
/// Otsu 1979, "A threshold selection method from gray-level histograms".
fn best_split(values: &[f32]) -> Option<f32> {
    let mut histogram = [0.0_f64; LEVELS];
    for value in values {
        histogram[(floor_i32(value.max(0.0)).unsigned_abs() as usize).min(LEVELS - 1)] += 1.0;
    }
    let total: f64 = histogram.iter().sum();
    let moment: f64 = histogram.iter().enumerate().map(|(i, count)| i as f64 * count).sum();
    let (mut below, mut below_moment, mut best) = (0.0, 0.0, (0.0, 0));
    for (level, count) in histogram.iter().enumerate() {
        below += count;
        below_moment += level as f64 * count;
        let above = total - below;
        if below > 0.0 && above > 0.0 {
            let apart = (below_moment / below) - (moment - below_moment) / above;
            let spread = below * above * apart * apart;
            if spread > best.0 {
                best = (spread, level);
            }
        }
    }
    (best.0 > 0.0).then_some((best.1 + 1) as f32)
}

#[cfg(test)]
mod tests {
    use image::Rgb;

    use super::*;

    #[test]
    fn a_green_disc_on_unevenly_lit_paper_is_found() {
        let disc = |x: u32, y: u32| (x as f32 - 50.0).hypot(y as f32 - 40.0) < 25.0;
        let picture = RgbImage::from_fn(100, 90, |x, y| {
            let light = u8::try_from(150 + x).expect("below 256");
            if disc(x, y) { Rgb([60, 120, 40]) } else { Rgb([light, light, light]) }
        });
        let mask = leaf_mask(&picture).expect("a disc stands out");
        let wrong = (0..9000u32).filter(|i| mask.inside[*i as usize] != disc(i % 100, i / 100)).count();
        assert!(wrong < 20, "{wrong} pixels are wrong");
    }

    #[test]
    fn nothing_stands_out_from_one_colour() {
        assert!(leaf_mask(&RgbImage::from_pixel(40, 30, Rgb([200, 190, 180]))).is_none(), "one colour");
        assert!(leaf_mask(&RgbImage::from_pixel(1, 1, Rgb([200, 190, 180]))).is_none(), "one pixel");
    }
}
