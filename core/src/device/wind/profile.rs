// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/profile.wgsl
//!
//! Growth of the mean wind and of turbulence with height.
//!
//! Rows lie at quarters of octaves of height, where a number's bits begin anew, so that a leaf on the ground meets the wind of its own
//! height: at 2 cm over ground of a roughness length of 5 mm a third of that at half a metre.

use crate::arith::lane::{Real, Word};
use crate::context::Context;
use crate::layout::Uint4;
use crate::scene::Profile;

crate::shared_constants! {
    /// Rows of the profile table: four for each of sixteen octaves.
    pub const PROFILE_ROWS: u32 = 64;
    /// Height of the first row in m; the wind is the same below.
    pub const PROFILE_LOWEST_M: f32 = 1.0 / 1024.0;
    /// Bits of that height.
    pub const PROFILE_LOWEST_BITS: u32 = PROFILE_LOWEST_M.to_bits();
    /// Height in m just below that of the row behind the last; the wind is the same above.
    pub const PROFILE_HIGHEST_M: f32 = 63.999_996;
    /// Bits of a height that count within a row.
    pub const PROFILE_SHIFT: u32 = 21;
    /// Share of a row that the lowest of these bits stands for.
    pub const PROFILE_UNIT: f32 = 1.0 / 2_097_152.0;
}

/// Height in m below which the wind follows the roughness of the ground beneath.
const SURFACE_LAYER_M: f64 = 1.0;

/// Mean wind at `height` metres above the ground relative to the reference height, and the share of level turbulence that is left there.
#[inline(always)]
pub fn wind_profile<R: Real>(cx: &Context<'_>, height: R) -> [R; 2] {
    let within = height.max(height.all(PROFILE_LOWEST_M)).min(height.all(PROFILE_HIGHEST_M));
    let bits = within.to_bits();
    let place = bits.minus(bits.all(PROFILE_LOWEST_BITS));
    let share = (place & ((1 << PROFILE_SHIFT) - 1)).to_real() * PROFILE_UNIT;
    let rows = &cx.tables[cx.scene.wind.first_profile_row as usize..];
    let row = (place >> PROFILE_SHIFT).look_up(bytemuck::cast_slice(rows));
    [row[0] + share * (row[1] - row[0]), row[2] + share * (row[3] - row[2])]
}

/// Share of vertical turbulence that the ground leaves at `height` metres above it.
#[inline(always)]
pub fn wind_vertical<R: Real>(cx: &Context<'_>, height: R) -> R {
    let wind = &cx.scene.wind;
    let share = height * wind.vertical_per_m + wind.least_vertical;
    share.max(height.all(0.0)).min(height.all(1.0))
}

/// The profile's factor at a height by its own law, in double precision.
pub fn profile_factor(profile: Profile, height_m: f64, reference_m: f64) -> f64 {
    match profile {
        Profile::Uniform => 1.0,
        Profile::Power { exponent } => libm::pow(height_m.max(0.0) / reference_m, f64::from(exponent)),
        Profile::Log { roughness_m, displacement_m } => {
            let (z0, d) = (f64::from(roughness_m), f64::from(displacement_m));
            let log = |z: f64| libm::log(((z - d) / z0).max(1.0));
            log(height_m) / log(reference_m)
        }
    }
}

/// Mean wind at a height above ground of roughness length `roughness_m`, relative to the reference height, and the share of level
/// turbulence left there, in double precision: what the table holds. Below one metre both follow the logarithmic law of the
/// ground's own roughness; a uniform wind has no ground.
pub fn surface_factors(profile: Profile, height_m: f64, reference_m: f64, roughness_m: f64) -> [f64; 2] {
    if profile == Profile::Uniform || height_m >= SURFACE_LAYER_M {
        return [profile_factor(profile, height_m, reference_m), 1.0];
    }
    let law = |height_m: f64| libm::log((height_m + roughness_m) / roughness_m);
    let share = law(height_m) / law(SURFACE_LAYER_M);
    [profile_factor(profile, SURFACE_LAYER_M, reference_m) * share, share]
}

/// Rows of the table: both numbers at a height, each with that at the next.
pub(crate) fn profile_rows(profile: Profile, reference_m: f32, roughness_m: f32) -> Vec<Uint4> {
    let at = |row: u32| {
        let height_m = f32::from_bits(PROFILE_LOWEST_BITS + (row << PROFILE_SHIFT));
        #[expect(clippy::cast_possible_truncation, reason = "tables are stored in single precision")]
        let bits = |factor: f64| (factor as f32).to_bits();
        surface_factors(profile, height_m.into(), reference_m.into(), roughness_m.into()).map(bits)
    };
    let entry = |row| {
        let ([mean, share], [next_mean, next_share]) = (at(row), at(row + 1));
        Uint4([mean, next_mean, share, next_share])
    };
    (0..PROFILE_ROWS).map(entry).collect()
}
