// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Number and directions of a blade's fine lines.

use glam::Vec2;

use super::portrait::Portrait;
use super::thinning::thin;
use crate::extract::ridge::{SCALES, ridges};
use crate::field::{Field, quantile};

/// Share of the blade that counts as veins: a fixed share repeats from photo to photo, a threshold does not.
const COVERAGE: f32 = 0.1;
/// Rim of the blade that is left out, in √A: margins fold, fray and keep shadows.
const RIM: f32 = 0.035;
/// Rim whose lightness is left out, in √A.
const MIXED: f32 = 0.02;
/// Angles at which sorted directions are compared.
const QUANTILES: usize = 180;

/// Length and directions of the strongest lines.
#[derive(Clone, Debug)]
pub(super) struct VeinPattern {
    /// Length of the thinned lines in √A.
    length: f32,
    /// Sorted angles to the midrib, 0 to 90°, at even quantiles.
    angles: Vec<f32>,
}

impl VeinPattern {
    /// Measures a blade.
    pub(super) fn of(portrait: &Portrait) -> Self {
        let (width, height) = (portrait.mask.width as usize, portrait.mask.height as usize);
        let lightness = Field { width, height, values: portrait.colours.iter().map(|lab| lab[0]).collect() };
        let ridges = ridges(&lightness, &portrait.depth, portrait.side, MIXED * portrait.side, &SCALES);
        let inner = portrait.inner(RIM * portrait.side);
        let threshold = quantile(
            &mut inner.iter().map(|i| ridges.strength.values[*i]).collect::<Vec<f32>>(),
            1.0 - COVERAGE,
        );
        let mut strong = vec![false; width * height];
        for &i in &inner {
            strong[i] = ridges.strength.values[i] > threshold.max(1e-6);
        }
        thin(&mut strong, width);
        let axis = portrait.axis;
        let turned = Vec2::new(axis.x * axis.x - axis.y * axis.y, 2.0 * axis.x * axis.y);
        let mut angles: Vec<f32> = (0..strong.len())
            .filter(|i| strong[*i])
            .map(|i| {
                let doubled = ridges.doubled[i];
                libm::atan2f(turned.perp_dot(doubled).abs(), turned.dot(doubled)).to_degrees() / 2.0
            })
            .collect();
        angles.sort_by(f32::total_cmp);
        let at = |q: usize| angles.get((2 * q + 1) * angles.len() / (2 * QUANTILES)).copied().unwrap_or(45.0);
        let angles = (0..QUANTILES).map(at).collect();
        Self { length: length(&strong, width) / portrait.side, angles }
    }

    /// Logarithm of the ratio of the lengths.
    pub(super) fn length_difference(&self, other: &Self) -> f32 {
        libm::logf(self.length.max(1e-3) / other.length.max(1e-3)).abs()
    }

    /// Wasserstein-1 distance of the angles in degrees.
    pub(super) fn angle_difference(&self, other: &Self) -> f32 {
        let pairs = self.angles.iter().zip(&other.angles);
        pairs.map(|(a, b)| (a - b).abs()).sum::<f32>() / QUANTILES as f32
    }
}

/// Length of thin lines: sides count 1, diagonals √2 where no way over a side leads there.
fn length(on: &[bool], width: usize) -> f32 {
    let at = |i: usize, dx: i32, dy: i32| {
        let x = i32::try_from(i % width).unwrap_or(0) + dx;
        let y = i32::try_from(i / width).unwrap_or(0) + dy;
        match (usize::try_from(x), usize::try_from(y)) {
            (Ok(x), Ok(y)) if x < width && y * width < on.len() => on[y * width + x],
            _ => false,
        }
    };
    let step = |i: usize| {
        let (right, down) = (at(i, 1, 0), at(i, 0, 1));
        let sides = f32::from(u8::from(right)) + f32::from(u8::from(down));
        let falling = at(i, 1, 1) && !right && !down;
        let rising = at(i, -1, 1) && !at(i, -1, 0) && !down;
        sides + std::f32::consts::SQRT_2 * (f32::from(u8::from(falling)) + f32::from(u8::from(rising)))
    };
    (0..on.len()).filter(|i| on[*i]).map(step).sum()
}
