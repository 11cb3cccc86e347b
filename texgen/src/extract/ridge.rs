// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fine lines of a picture: a multi-scale ridge filter.
//!
//! # Source
//! Sato et al. 1998, "Three-dimensional multi-scale line filter"; here in the plane: a ridge is where the
//! brightness bends strongly across one direction.

use glam::Vec2;

use crate::distance::nearest_seed;
use crate::field::{Field, quantile};

/// Widths of the lines looked for, in √A.
pub(crate) const SCALES: [f32; 4] = [0.005, 0.007, 0.009, 0.012];
/// Rim of the blade whose lines do not say whether lines are light or dark, in √A.
const RIM: f32 = 0.016;

/// Ridge strength of each pixel, and direction of its line.
#[derive(Clone, Debug)]
pub(crate) struct Ridges {
    /// Response, 0 for none; in units of the input per σ² of bending.
    pub(crate) strength: Field,
    /// Direction of the line as the unit vector of its doubled angle to the x axis.
    pub(crate) doubled: Vec<Vec2>,
}

/// Filters the lightness of a blade whose pixels lie `depth` pixels inside; `side` is √A in pixels, `scales` the
/// widths in √A. Lightness within `rim` pixels of the margin, mixed with the background's, is left out.
///
/// The polarity, light or dark lines, that answers more strongly among the blade's strongest tenth is kept.
pub(crate) fn ridges(lightness: &Field, depth: &[f32], side: f32, rim: f32, scales: &[f32]) -> Ridges {
    let filled = continued(lightness, depth, rim);
    let (width, height) = (filled.width, filled.height);
    let none = || Ridges {
        strength: Field::constant(width, height, 0.0),
        doubled: vec![Vec2::ZERO; width * height],
    };
    let (mut light, mut dark) = (none(), none());
    for scale in scales {
        let sigma = scale * side;
        let smooth = filled.blurred(sigma);
        let grid = |i: usize| i32::try_from(i).unwrap_or(i32::MAX);
        for i in (0..width * height).filter(|i| depth[*i] > 0.0) {
            let (column, row) = (grid(i % width), grid(i / width));
            let at = |dx: i32, dy: i32| smooth.at(column + dx, row + dy);
            let centre = 2.0 * at(0, 0);
            let xx = at(1, 0) + at(-1, 0) - centre;
            let yy = at(0, 1) + at(0, -1) - centre;
            let xy = (at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1)) / 4.0;
            let middle = (xx + yy) / 2.0;
            // Half the difference of the eigenvalues, along the doubled angle of the eigenvector of the larger.
            let across = Vec2::new((xx - yy) / 2.0, xy);
            let spread = across.length();
            let turned = across.normalize_or_zero();
            light.keep(i, (spread - middle) * sigma * sigma, turned);
            dark.keep(i, (spread + middle) * sigma * sigma, -turned);
        }
    }
    let strongest = |ridges: &Ridges| {
        let values = ridges.strength.values.iter().zip(depth);
        let mut inner: Vec<f32> = values.filter(|(_, d)| **d > RIM * side).map(|(v, _)| *v).collect();
        quantile(&mut inner, 0.95)
    };
    if strongest(&light) >= strongest(&dark) { light } else { dark }
}

impl Ridges {
    /// Strength that a fiftieth of the pixels on lines exceeds.
    pub(crate) fn strong(&self) -> f32 {
        let on_lines = self.strength.values.iter().filter(|value| **value > 0.0).copied();
        quantile(&mut on_lines.collect::<Vec<f32>>(), 0.98).max(1e-6)
    }

    /// Keeps the stronger of two answers at a pixel.
    fn keep(&mut self, i: usize, strength: f32, doubled: Vec2) {
        if strength > self.strength.values[i] {
            self.strength.values[i] = strength;
            self.doubled[i] = doubled;
        }
    }
}

/// The values deeper than `rim`, carried outward over everything else, so that no edge of the blade is left.
pub(crate) fn continued(field: &Field, depth: &[f32], rim: f32) -> Field {
    let deepest = depth.iter().copied().fold(0.0, f32::max);
    let rim = rim.min(deepest * 0.5);
    let (_, source) = nearest_seed(field.width, field.height, |i| depth[i] > rim);
    // Without any pixel that deep, each keeps its own value.
    let value = |(&own, &seed): (&f32, &u32)| field.values.get(seed as usize).copied().unwrap_or(own);
    let values = field.values.iter().zip(&source.data).map(value).collect();
    Field { values, ..*field }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square blade of side 100 in the middle of 140, with lines of the given contrast, sixteen apart.
    fn lined(contrast: f32) -> (Field, Vec<f32>) {
        let mut field = Field::constant(140, 140, 90.0);
        let mut depth = vec![0.0; 140 * 140];
        for (i, value) in field.values.iter_mut().enumerate() {
            let (x, y) = (i % 140, i / 140);
            let inner = x.min(y).min(139 - x).min(139 - y);
            if inner >= 20 {
                depth[i] = (inner - 19) as f32;
                *value = if x % 16 == 6 { 50.0 + contrast } else { 50.0 };
            }
        }
        (field, depth)
    }

    #[test]
    fn lines_answer_with_their_polarity_and_edges_do_not() {
        for contrast in [12.0, -12.0] {
            let (field, depth) = lined(contrast);
            let ridges = ridges(&field, &depth, 100.0, 1.0, &SCALES);
            let doubled = ridges.doubled[70 * 140 + 70];
            assert!(doubled.distance(Vec2::NEG_X) < 1e-3, "a line along y, not {doubled}");
            let on = ridges.strength.at(70, 70);
            assert!(on > 1.0, "the line answers with {on}");
            assert!(ridges.strength.at(46, 70) < 0.01 * on, "flat tissue does not answer");
            assert!(ridges.strength.at(20, 70) < 0.01 * on, "the blade's edge does not answer");
        }
    }
}
