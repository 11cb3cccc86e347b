// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/pile_shadow.wgsl
//!
//! Shelter of leaves that lie behind piles of litter: below a line that falls at 15° from higher litter upwind, as in Werner's model of
//! dunes ("Eolian dunes: computer simulations and attractor interpretation", 1995).

use crate::arith::math::inverse_sqrt;
use crate::arith::vector::{TINY_SQUARED, Vec3};
use crate::context::Context;
use crate::device::terrain::litter::ground_cover;

crate::shared_constants! {
    /// Distance in m upwind at which litter is sampled first; every further sample is twice as far.
    pub const PILE_NEAREST_M: f32 = 0.25;
    /// Number of samples: up to 2 m upwind.
    pub const PILE_SAMPLES: u32 = 4;
    /// Slope of the line: the tangent of 15°.
    pub const PILE_SLOPE: f32 = 0.267_949_2;
    /// Share of the wind that is missing deep below the line: an assumption, as behind hills.
    pub const PILE_LACK: f32 = 0.7;
    /// Inverse of the depth in m below the line at which all of that is missing, an assumption: ten layers of litter.
    pub const PILE_INV_DEPTH_M: f32 = 25.0;
}

/// Wind in m/s that piles of litter upwind leave at a leaf that lies on the litter at a place.
#[inline(always)]
pub fn wind_behind_piles(cx: &Context<'_>, x: f32, z: f32, wind: Vec3) -> Vec3 {
    let inverse = inverse_sqrt((wind.x * wind.x + wind.z * wind.z).max(TINY_SQUARED));
    let (toward_x, toward_z) = (wind.x * inverse, wind.z * inverse);
    let here = ground_cover(cx, x, z);
    let mut away = PILE_NEAREST_M;
    let mut depth = 0.0f32;
    for _ in 0..PILE_SAMPLES {
        let upwind = ground_cover(cx, x - toward_x * away, z - toward_z * away);
        depth = depth.max(upwind - (here + PILE_SLOPE * away));
        away = away + away;
    }
    wind * (1.0 - PILE_LACK * (depth * PILE_INV_DEPTH_M).min(1.0))
}
