// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles plumes at a moment.

use crate::blocks::PlumeBlock;
use crate::convert::single;
use crate::device::wind::plume::{PLUME_FLICKER, PLUME_PUFF, PlumeRise, plume_rise};
use crate::device::wind::profile::surface_factors;
use crate::scene::{Plume, Scene};

/// Height of the middle of the steady flame over Q^0.4 in m / kW^0.4: below it the axis leans as there.
const FLAME_MIDDLE: f64 = 0.04;
/// Puffs a second above a fire a metre wide (Cetegen & Ahmed 1993); the wider, the fewer.
const PUFFS: f64 = 1.5;
/// Height of the layer that the ground slows, in radii of the fire.
const LAYER: f64 = 0.1;

/// Lowest height in m at which the lean is followed, but for the base; each other one is twice the one before.
const LOWEST_BEND_M: f64 = 0.5;

/// Speed in m/s that a fire of so many kW gives its plume, `Q^0.2`.
fn speed_m_s(power_kw: f64) -> f64 {
    libm::pow(power_kw, 0.2)
}

/// Fastest speed on the axis of a plume in m/s.
pub(super) fn fastest_m_s(plume: &Plume) -> f64 {
    f64::from(PLUME_FLICKER * (1.0 + PLUME_PUFF)) * speed_m_s(plume.greatest_kw())
}

/// Puffs a second above a fire, by its width.
pub(super) fn puffs_per_s(plume: &Plume) -> f64 {
    PUFFS / libm::sqrt(2.0 * f64::from(plume.base_radius_m))
}

/// A plume at a time, after so many puffs of which so many leave it in a second, leaning in the mean wind of a scene over ground of a height.
pub(super) fn plume_block(
    scene: &Scene,
    plume: &Plume,
    time_s: f64,
    (puffs_per_s, puffs): (f64, f64),
    ground_m: f64,
) -> PlumeBlock {
    let mut block: PlumeBlock = bytemuck::Zeroable::zeroed();
    let wind = &scene.wind;
    let roughness_m = f64::from(scene.ground.surface_roughness_m);
    let factors =
        |height_m: f64| surface_factors(wind.profile, height_m, wind.reference_height_m.into(), roughness_m);
    let base_m = (f64::from(plume.at_m.y) - ground_m).max(0.0);
    let [_, level] = factors(LAYER * f64::from(plume.base_radius_m));
    block.base_m = plume.at_m.to_array();
    block.base_radius_m = plume.base_radius_m;
    block.inv_layer = single(1.0 / level);
    block.puffs_per_s = single(puffs_per_s);
    block.puffs = single(puffs - libm::floor(puffs));
    if let Some(within_m) = plume.fed_within_m {
        block.feeding_m2 = within_m * within_m;
    }
    let power_kw = plume.power_kw(time_s);
    if power_kw <= 0.0 {
        return block;
    }
    let fire_m_s = speed_m_s(power_kw);
    let heights_per_m = 1.0 / (fire_m_s * fire_m_s);
    block.speed_m_s = single(fire_m_s);
    block.heights_per_m = single(heights_per_m);
    let middle_m = FLAME_MIDDLE / heights_per_m;
    let slope = |height_m: f64| {
        let height_m = height_m.max(middle_m);
        let [mean, _] = factors(base_m + height_m);
        let PlumeRise { speed, .. } = plume_rise(single(height_m * heights_per_m));
        wind.speed.metres_per_second() * mean / (f64::from(speed) * fire_m_s)
    };
    block.base_slope = single(slope(0.0));
    let (mut low_m, mut bend_before) = (0.0, 0.0);
    // The last one ends the bending: above, the axis is straight.
    let (last, others) = block.bends.split_last_mut().unwrap_or_else(|| unreachable!("a plume has bends"));
    for bend in others {
        let high_m = f64::max(2.0 * low_m, LOWEST_BEND_M);
        let turned_per_m = (slope(high_m) - slope(low_m)) / (high_m - low_m);
        (bend.from_m, bend.turned_per_m) = (single(low_m), single(turned_per_m - bend_before));
        (low_m, bend_before) = (high_m, turned_per_m);
    }
    (last.from_m, last.turned_per_m) = (single(low_m), single(-bend_before));
    block
}
