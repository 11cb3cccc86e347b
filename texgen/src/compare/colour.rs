// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours of a blade: their mean and their distribution.

use super::difference::delta_e2000;
use super::portrait::Portrait;
use crate::lab::Lab;

/// Directions onto which colours are projected.
const DIRECTIONS: usize = 64;
/// Points at which sorted projections are compared.
const QUANTILES: usize = 256;

/// Mean colour and projected colour distributions.
#[derive(Clone, Debug)]
pub(super) struct Colours {
    mean: Lab,
    /// For each direction the quantiles of the colours minus their mean.
    projected: Vec<Vec<f32>>,
}

impl Colours {
    /// Measures a blade.
    pub(super) fn of(portrait: &Portrait) -> Self {
        let pixels = portrait.inner(0.0);
        let count = pixels.len().max(1) as f32;
        let mean: Lab =
            std::array::from_fn(|c| pixels.iter().map(|i| portrait.colours[*i][c]).sum::<f32>() / count);
        let mut line = Vec::with_capacity(pixels.len());
        let projected = (0..DIRECTIONS).map(|k| {
            let direction = direction(k);
            line.clear();
            line.extend(pixels.iter().map(|i| {
                let colour = portrait.colours[*i];
                (0..3).map(|c| (colour[c] - mean[c]) * direction[c]).sum::<f32>()
            }));
            line.sort_by(f32::total_cmp);
            (0..QUANTILES)
                .map(|q| line.get((2 * q + 1) * line.len() / (2 * QUANTILES)).copied().unwrap_or(0.0))
                .collect()
        });
        Self { mean, projected: projected.collect() }
    }

    /// CIEDE2000 between the mean colours.
    pub(super) fn mean_difference(&self, other: &Self) -> f32 {
        delta_e2000(self.mean, other.mean)
    }

    /// Sliced Wasserstein-1 distance of the colours, and of the colours minus their means.
    ///
    /// # Source
    /// Rabin, Peyré, Delon and Bernot 2011, "Wasserstein barycenter and its application to texture mixing".
    pub(super) fn sliced_wasserstein(&self, other: &Self) -> (f32, f32) {
        let (mut raw, mut centred) = (0.0, 0.0);
        for (k, (a, b)) in self.projected.iter().zip(&other.projected).enumerate() {
            let direction = direction(k);
            let shift: f32 = (0..3).map(|c| (self.mean[c] - other.mean[c]) * direction[c]).sum();
            for (a, b) in a.iter().zip(b) {
                raw += (a - b + shift).abs();
                centred += (a - b).abs();
            }
        }
        let count = (DIRECTIONS * QUANTILES) as f32;
        (raw / count, centred / count)
    }
}

/// Directions spread evenly over the half sphere (a Fibonacci lattice).
fn direction(k: usize) -> [f32; 3] {
    let z = (k as f32 + 0.5) / DIRECTIONS as f32;
    let (sin, cos) = libm::sincosf(k as f32 * 2.399_963_3);
    let radius = (1.0 - z * z).sqrt();
    [radius * cos, radius * sin, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(mean: Lab, spread: f32) -> Colours {
        let line: Vec<f32> = (0..QUANTILES).map(|q| spread * (q as f32 / 127.5 - 1.0)).collect();
        Colours { mean, projected: vec![line; DIRECTIONS] }
    }

    #[test]
    fn a_shift_of_the_mean_is_raw_only_and_spread_is_both() {
        let (raw, centred) = flat([50.0, 0.0, 0.0], 0.0).sliced_wasserstein(&flat([60.0, 0.0, 0.0], 0.0));
        assert!((raw - 5.0).abs() < 0.2, "mean projection of a shift of 10 is 5, got {raw}");
        assert!(centred < 1e-6, "centred {centred}");
        let (raw, centred) = flat([50.0, 0.0, 0.0], 1.0).sliced_wasserstein(&flat([50.0, 0.0, 0.0], 3.0));
        assert!((raw - 1.0).abs() < 0.02 && (raw - centred).abs() < 1e-6, "{raw} {centred}");
    }
}
