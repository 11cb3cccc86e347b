// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fine texture of a blade: local binary patterns and co-occurring grey levels.

use glam::Vec2;

use super::portrait::Portrait;
use crate::field::Field;
use crate::math::floor_i32;

/// Circles of the local binary patterns: samples and radius in pixels.
const CIRCLES: [(usize, f32); 2] = [(8, 1.0), (16, 2.0)];
/// Distances of the co-occurrence matrices in pixels.
const DISTANCES: [i32; 2] = [1, 3];
/// Grey levels of the co-occurrence matrices.
const LEVELS: usize = 32;
/// Features of both matrices.
const FEATURES: usize = 8;
/// Standard deviations of the features over our 24 photos of seven species.
const DEVIATIONS: [f32; FEATURES] = [0.3376, 0.0747, 0.0722, 0.1044, 1.2604, 0.1179, 0.0999, 0.1063];

/// Histograms of patterns, and features of co-occurrence.
#[derive(Clone, Debug)]
pub(super) struct Texture {
    patterns: Vec<Vec<f32>>,
    features: [f32; FEATURES],
}

impl Texture {
    /// Measures a blade.
    pub(super) fn of(portrait: &Portrait) -> Self {
        let (width, height) = (portrait.mask.width as usize, portrait.mask.height as usize);
        let grey = |lab: &[f32; 3]| (lab[0] * 2.55 + 0.5).floor();
        let lightness = Field { width, height, values: portrait.colours.iter().map(grey).collect() };
        let patterns = CIRCLES.iter().map(|circle| patterns(&lightness, portrait, *circle)).collect();
        let mut features = [0.0; FEATURES];
        for (distance, four) in DISTANCES.iter().zip(features.chunks_exact_mut(4)) {
            four.copy_from_slice(&co_occurrence(&lightness, portrait, *distance));
        }
        Self { patterns, features }
    }

    /// Jensen-Shannon distance of the pattern histograms, mean over the circles.
    pub(super) fn pattern_difference(&self, other: &Self) -> f32 {
        let pairs = self.patterns.iter().zip(&other.patterns);
        pairs.map(|(a, b)| jensen_shannon(a, b)).sum::<f32>() / CIRCLES.len() as f32
    }

    /// Root mean square difference of the co-occurrence features, each in its standard deviation.
    pub(super) fn feature_difference(&self, other: &Self) -> f32 {
        let pairs = self.features.iter().zip(&other.features).zip(&DEVIATIONS);
        let squares: f32 =
            pairs.map(|((a, b), deviation)| ((a - b) / deviation) * ((a - b) / deviation)).sum();
        (squares / FEATURES as f32).sqrt()
    }
}

/// Histogram of rotation-invariant uniform patterns.
///
/// # Source
/// Ojala, Pietikäinen and Mäenpää 2002, "Multiresolution gray-scale and rotation invariant texture classification
/// with local binary patterns", eq. 9 to 11.
fn patterns(grey: &Field, portrait: &Portrait, (samples, radius): (usize, f32)) -> Vec<f32> {
    let circle: Vec<Vec2> = (0..samples)
        .map(|k| {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * k as f32 / samples as f32);
            Vec2::new(cos, -sin) * radius
        })
        .collect();
    let mut histogram = vec![0.0; samples + 2];
    let inner = portrait.inner(radius + 1.0);
    for &i in &inner {
        let centre = Vec2::new((i % grey.width) as f32 + 0.5, (i / grey.width) as f32 + 0.5);
        // A little slack keeps equal neighbours equal after interpolation.
        let lighter = |k: usize| grey.sample(centre + circle[k]) >= grey.values[i] - 1e-3;
        let signs: Vec<bool> = (0..samples).map(lighter).collect();
        let changes = (0..samples).filter(|k| signs[*k] != signs[(k + 1) % samples]).count();
        let code = if changes <= 2 { signs.iter().filter(|sign| **sign).count() } else { samples + 1 };
        histogram[code] += 1.0 / inner.len() as f32;
    }
    histogram
}

/// Jensen-Shannon distance of two histograms, 0 to 1: the root of their divergence in bits.
fn jensen_shannon(a: &[f32], b: &[f32]) -> f32 {
    let term = |p: f32, m: f32| if p > 0.0 { p * libm::log2f(p / m) } else { 0.0 };
    let pairs = a.iter().zip(b);
    let sum: f32 = pairs.map(|(a, b)| term(*a, (a + b) / 2.0) + term(*b, (a + b) / 2.0)).sum();
    (sum / 2.0).max(0.0).sqrt()
}

/// Contrast, homogeneity, correlation and energy of grey levels at a distance, mean over four directions.
///
/// # Source
/// Haralick, Shanmugam and Dinstein 1973, "Textural features for image classification".
fn co_occurrence(grey: &Field, portrait: &Portrait, distance: i32) -> [f32; 4] {
    let level =
        |value: f32| usize::try_from(floor_i32(value / 256.0 * LEVELS as f32)).unwrap_or(0).min(LEVELS - 1);
    let mut mean = [0.0; 4];
    for (dx, dy) in [(1, 0), (1, 1), (0, 1), (-1, 1)] {
        let (dx, dy) = (dx * distance, dy * distance);
        let mut counts = vec![0.0_f64; LEVELS * LEVELS];
        let mut total = 0.0_f64;
        for y in 0..i32::try_from(grey.height).unwrap_or(0) {
            for x in 0..i32::try_from(grey.width).unwrap_or(0) {
                if portrait.mask.contains(x, y) && portrait.mask.contains(x + dx, y + dy) {
                    let (a, b) = (level(grey.at(x, y)), level(grey.at(x + dx, y + dy)));
                    counts[a * LEVELS + b] += 1.0;
                    counts[b * LEVELS + a] += 1.0;
                    total += 2.0;
                }
            }
        }
        let features = haralick(&counts, total.max(1.0));
        mean.iter_mut().zip(features).for_each(|(mean, feature)| *mean += feature / 4.0);
    }
    mean
}

/// The four features of one symmetric matrix of counts.
fn haralick(counts: &[f64], total: f64) -> [f32; 4] {
    let cells = || {
        counts.iter().enumerate().map(|(k, count)| ((k / LEVELS) as f64, (k % LEVELS) as f64, count / total))
    };
    let mean: f64 = cells().map(|(i, _, p)| i * p).sum();
    let variance: f64 = cells().map(|(i, _, p)| (i - mean) * (i - mean) * p).sum();
    let covariance: f64 = cells().map(|(i, j, p)| (i - mean) * (j - mean) * p).sum();
    let contrast: f64 = cells().map(|(i, j, p)| (i - j) * (i - j) * p).sum();
    let homogeneity: f64 = cells().map(|(i, j, p)| p / (1.0 + (i - j) * (i - j))).sum();
    let energy = cells().map(|(_, _, p)| p * p).sum::<f64>().sqrt();
    let correlation = if variance > 1e-12 { covariance / variance } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    let features = [contrast, homogeneity, correlation, energy].map(|feature| feature as f32);
    features
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_zero_for_equals_and_one_for_strangers() {
        assert_eq!(jensen_shannon(&[0.5, 0.5], &[0.5, 0.5]), 0.0, "equal");
        assert!((jensen_shannon(&[1.0, 0.0], &[0.0, 1.0]) - 1.0).abs() < 1e-6, "nothing in common");
    }

    #[test]
    fn a_checkerboard_matrix_has_the_known_features() {
        // Levels 0 and 1, always next to each other.
        let mut counts = vec![0.0; LEVELS * LEVELS];
        counts[1] = 10.0;
        counts[LEVELS] = 10.0;
        let [contrast, homogeneity, correlation, energy] = haralick(&counts, 20.0);
        assert!(
            (contrast - 1.0).abs() < 1e-6 && (homogeneity - 0.5).abs() < 1e-6,
            "{contrast} {homogeneity}"
        );
        assert!((correlation + 1.0).abs() < 1e-6, "opposite levels: {correlation}");
        assert!((energy - 0.5_f32.sqrt()).abs() < 1e-6, "{energy}");
    }
}
