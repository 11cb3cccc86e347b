// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/gust.wgsl
//!
//! Gusts: fronts of faster air, between them slower air, carried along by the mean wind.

use std::f64::consts::TAU;

use crate::arith::lane::Real;
use crate::arith::rng::random;
use crate::blocks::MomentBlock;
use crate::context::Context;
use crate::device::wind::row::{wind_entry, wind_row};
use crate::layout::Uint4;

crate::shared_constants! {
    /// Rows of the gust table, a power of two.
    pub const GUST_ROWS: u32 = 1024;
    /// Rows from one gust to the next, on average.
    pub const GUST_SPACING: u32 = 16;
}

/// Stream of random numbers, apart from those of leaves.
const STREAM: u32 = 0x4755_0000;

/// Excess over the mean wind, in units of a typical gust's, at `along` metres down the wind.
#[inline(always)]
pub fn wind_gust<R: Real>(cx: &Context<'_>, moment: &MomentBlock, along: R) -> R {
    let x = along * cx.scene.wind.gust_rows_per_m - moment.gust_offset;
    let k = x.floor();
    let index = k.to_whole() & (GUST_ROWS - 1);
    let row = wind_row(cx, index, cx.scene.wind.first_gust_row);
    row[0] + (x - k) * (row[1] - row[0])
}

/// Rows of the table: the value at a place and at the next, for so many different gusts, a divisor of all. Gusts are `1 - cos` humps of random height, length and
/// place, one to a spacing. The mean over the table is zero, so that gusts leave the mean wind alone, and the mean of
/// the humps' peaks is one. Lulls come to -1/2, so that the air never turns back at any strength a scene may ask for.
pub(crate) fn gust_rows(seed: [u32; 2], different: u32) -> Vec<Uint4> {
    let rows = GUST_ROWS as usize;
    let mut values = vec![0.0; rows];
    for gust in 0..GUST_ROWS / GUST_SPACING {
        let [place, length, height, _] =
            random(seed, gust % different, STREAM).map(|word| f64::from(word) / 4_294_967_296.0);
        let spacing = f64::from(GUST_SPACING);
        let centre = (f64::from(gust) + 0.2 + 0.6 * place) * spacing;
        let width = (0.4 + 0.5 * length) * spacing;
        for (row, value) in values.iter_mut().enumerate() {
            let mut distance = (row as f64 - centre).abs();
            distance = distance.min(rows as f64 - distance);
            if distance < 0.5 * width {
                *value += (0.6 + 0.8 * height) * 0.5 * (1.0 + libm::cos(TAU * distance / width));
            }
        }
    }
    let mean = values.iter().sum::<f64>() / rows as f64;
    let peaks: f64 =
        values.chunks(GUST_SPACING as usize).map(|gust| gust.iter().copied().fold(0.0, f64::max)).sum();
    let scale = 1.0 / (peaks / f64::from(GUST_ROWS / GUST_SPACING) - mean);
    #[expect(clippy::cast_possible_truncation, reason = "tables are stored in single precision")]
    let at = |row: usize| ((values[row % rows] - mean) * scale) as f32;
    (0..rows).map(|row| wind_entry(at(row), at(row + 1))).collect()
}
