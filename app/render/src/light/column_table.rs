// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Table of the air between a place and the sun.

use super::atmosphere::{Columns, EARTH_KM, TOP_KM, densities};
use super::table::{cell, single};

const HEIGHTS: usize = 48;
const DIRECTIONS: usize = 96;
/// Steps of the sum along a ray.
const STEPS: u32 = 64;
/// Sine of the sun's angular radius.
const SUN_RADIUS: f64 = 0.00465;

/// Columns from places in the air out to space.
///
/// The axes are those of Bruneton and Neyret (2008): distance to the horizon, and length of the ray, which are smooth where
/// cosines are steep.
#[derive(Debug)]
pub(super) struct ColumnTable(Vec<Columns>);

impl ColumnTable {
    pub(super) fn new() -> Self {
        let mut rows = Vec::with_capacity(HEIGHTS * DIRECTIONS);
        for height in 0..HEIGHTS {
            let to_horizon = horizon_of_top() * height as f64 / (HEIGHTS - 1) as f64;
            let radius = (to_horizon * to_horizon + EARTH_KM * EARTH_KM).sqrt();
            for direction in 0..DIRECTIONS {
                let (shortest, longest) = (TOP_KM - radius, to_horizon + horizon_of_top());
                let share = direction as f64 / (DIRECTIONS - 1) as f64;
                let length = shortest + (longest - shortest) * share;
                let cos = if length > 1e-6 {
                    (TOP_KM * TOP_KM - radius * radius - length * length) / (2.0 * radius * length)
                } else {
                    1.0
                };
                rows.push(columns(radius, cos, length));
            }
        }
        Self(rows)
    }

    /// Columns from a radius towards a zenith cosine, out to space, and the share of the sun's disc above the horizon.
    pub(super) fn toward_sun(&self, radius: f64, cos: f64) -> (Columns, f32) {
        let to_horizon = (radius * radius - EARTH_KM * EARTH_KM).max(0.0).sqrt();
        let lowest = -to_horizon / radius;
        let visible = single(((cos - lowest) / (2.0 * SUN_RADIUS) + 0.5).clamp(0.0, 1.0));
        let cos = cos.max(lowest);
        let reach = (radius * radius * (cos * cos - 1.0) + TOP_KM * TOP_KM).max(0.0).sqrt();
        let length = reach - radius * cos;
        let (shortest, longest) = (TOP_KM - radius, to_horizon + horizon_of_top());
        let x = (length - shortest) / (longest - shortest) * (DIRECTIONS - 1) as f64;
        let y = to_horizon / horizon_of_top() * (HEIGHTS - 1) as f64;
        let ((column, fx), (row, fy)) = (cell(x, DIRECTIONS), cell(y, HEIGHTS));
        let at = row * DIRECTIONS + column;
        let [a, b] = [&self.0[at], &self.0[at + 1]];
        let [c, d] = [&self.0[at + DIRECTIONS], &self.0[at + DIRECTIONS + 1]];
        let mix =
            |i: usize| (a[i] * (1.0 - fx) + b[i] * fx) * (1.0 - fy) + (c[i] * (1.0 - fx) + d[i] * fx) * fy;
        (std::array::from_fn(mix), visible)
    }
}

/// Distance from the ground's horizon to the end of the air.
fn horizon_of_top() -> f64 {
    (TOP_KM * TOP_KM - EARTH_KM * EARTH_KM).sqrt()
}

/// Sums densities along a ray; steps are short near its start, where the air is densest for most rays.
fn columns(radius: f64, cos: f64, length: f64) -> Columns {
    let mut sum = [0.0; 3];
    for step in 0..STEPS {
        let [from, to] = [step, step + 1].map(|edge| (f64::from(edge) / f64::from(STEPS)).powi(2) * length);
        let at = 0.5 * (from + to);
        let height = (radius * radius + at * at + 2.0 * radius * cos * at).sqrt() - EARTH_KM;
        for (sum, density) in sum.iter_mut().zip(densities(height.max(0.0))) {
            *sum += density * (to - from);
        }
    }
    sum
}
