// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Blends the flat colours of superpixels: minimises Σ‖x_i − x'_i‖² + Σ w_ij ‖x_i − x_j‖² over neighbouring pixels
//! (equation 2 of the source with the squares that its equation 3 follows from).

use super::structure::Structure;
use crate::lab::Lab;
use crate::math::floor_i32;

/// Reach of the blur as a share of √A; its square is the weight of smoothness in pixels².
const REACH: f32 = 0.006;
/// Structural distance between neighbours that counts as an edge.
const EDGE: f32 = 0.05;
/// Share of the smoothness that is left across the border of two regions.
const ACROSS_REGIONS: f32 = 0.5;
/// Sweeps stop when no colour of a sweep moves farther than this.
const STILL: f32 = 1.0 / 512.0;
/// Most sweeps.
const MAX_SWEEPS: usize = 400;

/// Solves for the smooth colours by red-black Gauss-Seidel sweeps with over-relaxation.
pub(crate) fn smooth(leaf: &Structure, colour: &[Lab]) -> Vec<Lab> {
    let weight = (REACH * leaf.unit) * (REACH * leaf.unit);
    let between = |a: usize, b: usize| {
        let step = (leaf.distance[a] - leaf.distance[b]) / EDGE;
        let border = if leaf.region.data[a] == leaf.region.data[b] { 1.0 } else { ACROSS_REGIONS };
        weight * border * libm::expf(-step * step)
    };
    // Links to the pixels on the right and below, and for each pixel the places of its four links.
    let width = leaf.inside.width;
    let linked = |a: usize, b: usize| if leaf.inside.data[b] { between(a, b) } else { 0.0 };
    let mut right = vec![0.0; leaf.inside.data.len()];
    let mut below = vec![0.0; leaf.inside.data.len()];
    for at in leaf.pixels() {
        if at % width + 1 < width {
            right[at] = linked(at, at + 1);
        }
        if at / width + 1 < leaf.inside.height {
            below[at] = linked(at, at + width);
        }
    }
    let jacobi = 4.0 * weight / (1.0 + 4.0 * weight);
    let relaxation = 2.0 / (1.0 + (1.0 - jacobi * jacobi).sqrt());
    let is_red = |at: usize| (at % width + at / width).is_multiple_of(2);
    let red: Vec<usize> = leaf.pixels().filter(|&at| is_red(at)).collect();
    let black: Vec<usize> = leaf.pixels().filter(|&at| !is_red(at)).collect();
    let mut x = colour.to_vec();
    for _ in 0..MAX_SWEEPS {
        let mut largest = 0.0_f32;
        for half in [&red, &black] {
            for &at in half {
                let mut sum = colour[at];
                let mut total = 1.0;
                let mut pull = |weight: f32, other: usize| {
                    if weight > 0.0 {
                        for channel in 0..3 {
                            sum[channel] += weight * x[other][channel];
                        }
                        total += weight;
                    }
                };
                pull(right[at], at + 1);
                pull(below[at], at + width);
                if at % width > 0 {
                    pull(right[at - 1], at - 1);
                }
                if at >= width {
                    pull(below[at - width], at - width);
                }
                for channel in 0..3 {
                    let move_by = relaxation * (sum[channel] / total - x[at][channel]);
                    x[at][channel] += move_by;
                    largest = largest.max(move_by.abs());
                }
            }
        }
        if largest < STILL {
            break;
        }
    }
    x
}

/// Mean of the pixels within a square of 2 `reach` + 1 pixels that `counts` accepts; zero where there are none.
pub(crate) fn local_mean(
    leaf: &Structure,
    colour: &[Lab],
    reach: f32,
    counts: impl Fn(usize) -> bool,
) -> Vec<Lab> {
    let (width, height) = (leaf.inside.width, leaf.inside.height);
    let reach = usize::try_from(floor_i32(reach)).unwrap_or(0).max(1);
    // Sums over all that is above and to the left; the fourth number counts. Of their rows only those are kept that a square
    // reaches.
    let kept = 2 * reach + 2;
    let mut table = vec![[0.0_f64; 4]; kept * (width + 1)];
    let start = |row: usize| row % kept * (width + 1);
    let mut means = Vec::with_capacity(width * height);
    let mut summed = 0;
    for y in 0..height {
        let (top, bottom) = (y.saturating_sub(reach), (y + reach + 1).min(height));
        while summed < bottom {
            let (above, below) = (start(summed), start(summed + 1));
            let mut row = [0.0_f64; 4];
            for x in 0..width {
                let at = summed * width + x;
                if counts(at) {
                    for (sum, value) in row.iter_mut().zip(colour[at]) {
                        *sum += f64::from(value);
                    }
                    row[3] += 1.0;
                }
                let above = table[above + x + 1];
                table[below + x + 1] = std::array::from_fn(|i| above[i] + row[i]);
            }
            summed += 1;
        }
        let (top, bottom) = (&table[start(top)..], &table[start(bottom)..]);
        means.extend((0..width).map(|x| {
            let (left, right) = (x.saturating_sub(reach), (x + reach + 1).min(width));
            let sum: [f64; 4] =
                std::array::from_fn(|i| bottom[right][i] - bottom[left][i] - top[right][i] + top[left][i]);
            #[expect(clippy::cast_possible_truncation, reason = "a mean of single precision values is one")]
            let mean = |i: usize| if sum[3] > 0.5 { (sum[i] / sum[3]) as f32 } else { 0.0 };
            [mean(0), mean(1), mean(2)]
        }));
    }
    means
}
