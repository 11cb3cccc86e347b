// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles what water does with leaves.

use super::block::REST_OFFSET_M;
use crate::blocks::LitterBlock;
use crate::convert::{single, word};
use crate::device::leaf::afloat::FLOAT_WIND_M;
use crate::device::wind::profile::surface_factors;
use crate::scene::{Litter, Scene, WindParameters};

/// Drag coefficient of open water by the wind at 10 m, from 4 to 11 m/s (Large and Pond 1981).
const WATER_DRAG: f64 = 1.2e-3;
/// Speed of the surface that the wind drags along, relative to its friction velocity (Wu 1975).
const SURFACE_DRIFT: f64 = 0.55;
/// Von Kármán's constant.
const KARMAN: f64 = 0.4;
/// Height of the edges of a leaf above the water in m; an assumption.
const EDGE_M: f64 = 0.005;
/// Density of the air over that of water.
const AIR_OVER_WATER: f64 = 1.2e-3;
/// Drag coefficient of a leaf's dry side over that of its wet one, which pushes its rim through the water; an assumption.
const DRY_OVER_WET_DRAG: f64 = 0.5;
/// Height in m of the wind that drift is a share of.
const WIND_M: f64 = 10.0;
/// Time in s within which a leaf, with the water that clings to it, follows the wind; an assumption.
const RESPONSE_S: f64 = 1.0;

/// Speed of a leaf afloat over that of the wind at 10 m, 0.027: the surface's own, and that at which drag of the air over the leaf balances
/// that of the water beneath. The rule of thumb is 0.02 to 0.03.
fn drift_of_wind() -> f64 {
    let friction = libm::sqrt(WATER_DRAG);
    let roughness_m = WIND_M * libm::exp(-KARMAN / friction);
    let at_edge = friction / KARMAN * libm::log(EDGE_M / roughness_m);
    SURFACE_DRIFT * friction + libm::sqrt(AIR_OVER_WATER * DRY_OVER_WET_DRAG) * at_edge
}

/// Height of water on which leaves float, in m above the ground at the origin.
pub(super) fn floating_surface_m(scene: &Scene) -> Option<f32> {
    let is_living = scene.ground.litter.is_some_and(|litter| !litter.still);
    let water = scene.ground.water.filter(|_| is_living)?;
    let above_m = water.height_m - scene.ground.height_m;
    (scene.ground.terrain.is_some() || above_m > 0.0).then_some(above_m)
}

/// Sets how leaves float.
pub(super) fn set_floating(scene: &Scene, litter: &Litter, block: &mut LitterBlock) {
    block.soaking_steps = 0;
    block.bottom_m = scene.ground.height_m + REST_OFFSET_M;
    if floating_surface_m(scene).is_none() {
        return;
    }
    let dt_s = f64::from(scene.dt_s);
    let WindParameters { profile, reference_height_m, .. } = scene.wind;
    let roughness_m = f64::from(scene.ground.surface_roughness_m);
    let mean = |height_m: f64| surface_factors(profile, height_m, reference_height_m.into(), roughness_m)[0];
    let low = mean(FLOAT_WIND_M.into());
    block.soaking_steps = word(f64::from(litter.float_hours) * 3600.0 / dt_s).max(1);
    block.drift_share = if low > 0.0 { single(drift_of_wind() * mean(WIND_M) / low) } else { 0.0 };
    block.drift_kept = single(libm::exp(-f64::from(block.wake_steps) * dt_s / RESPONSE_S));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_drift_with_two_to_three_hundredths_of_the_wind() {
        let share = drift_of_wind();
        assert!((0.02..0.03).contains(&share), "{share}");
    }
}
