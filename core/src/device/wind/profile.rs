// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/profile.wgsl
//!
//! Growth of the mean wind with height.

use crate::arith::lane::Real;
use crate::context::Context;
use crate::device::wind::row::{wind_entry, wind_row};
use crate::layout::Uint4;
use crate::scene::Profile;

crate::shared_constants! {
    /// Rows of the profile table.
    pub const PROFILE_ROWS: u32 = 128;
    /// Largest place in the table that still has a row above it.
    pub const PROFILE_TOP: f32 = 126.999;
    /// Rows per metre of height.
    pub const PROFILE_PER_METRE: f32 = 2.0;
}

/// Mean wind at `height` metres above the ground relative to the reference height; constant above 63 m.
#[inline(always)]
pub fn wind_profile<R: Real>(cx: &Context<'_>, height: R) -> R {
    let x = (height * PROFILE_PER_METRE).max(height.all(0.0)).min(height.all(PROFILE_TOP));
    let k = x.floor();
    let row = wind_row(cx, k.to_whole(), cx.scene.wind.first_profile_row);
    row[0] + (x - k) * (row[1] - row[0])
}

/// The profile's factor at a height, in double precision: what the table samples.
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

/// Rows of the table: the value at a height and at the next.
pub(crate) fn profile_rows(profile: Profile, reference_m: f32) -> Vec<Uint4> {
    #[expect(clippy::cast_possible_truncation, reason = "tables are stored in single precision")]
    let at = |row: u32| {
        profile_factor(profile, f64::from(row) / f64::from(PROFILE_PER_METRE), f64::from(reference_m)) as f32
    };
    (0..PROFILE_ROWS).map(|row| wind_entry(at(row), at(row + 1))).collect()
}
