// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places of births in a hull, in proportion to the light there, by rejection.

use glam::DVec3;

use super::FlowError;
use super::hull::Hull;
use super::light::LightGrid;
use crate::tree::grammar::Draws;

/// Step number of the draws of births, which no step of a derivation has.
const BIRTH_DRAWS: u32 = 1 << 17;
/// Most draws for a birth.
const MOST_TRIES: u32 = 2000;

/// Least distance in m of a birth from what is in its way from above the foot.
const CLEARANCE_M: f64 = 0.3;

/// As many places inside a hull, none of them behind an obstacle that stands between it and the vertical through the foot. The chance of a place goes with the light there by a share of `by_light`; the rest is the same everywhere.
///
/// # Errors
/// [`FlowError::Births`] in a hull that is too thin or too dark.
pub(super) fn births(
    hull: &Hull,
    light: &LightGrid,
    by_light: f64,
    count: u32,
    meets: &impl Fn(DVec3, DVec3) -> Option<f64>,
    draws: impl Fn(u32, u32) -> Draws,
) -> Result<Vec<DVec3>, FlowError> {
    let (low_m, size_m) = (hull.low_m(), hull.high_m() - hull.low_m());
    let most = light.most();
    let mut places = Vec::with_capacity(count as usize);
    let mut tries = 0;
    while places.len() < count as usize {
        if tries / count.max(1) >= MOST_TRIES {
            let found = crate::convert::len32(places.len());
            return Err(FlowError::Births { found, wanted: count });
        }
        let mut draw = draws(BIRTH_DRAWS, tries);
        tries += 1;
        let place = low_m + DVec3::new(draw.unit(), draw.unit(), draw.unit()) * size_m;
        if !hull.holds(place) {
            continue;
        }
        let out = DVec3::new(place.x, 0.0, place.z);
        let is_hidden = out.try_normalize().is_some_and(|toward| {
            let first_m = meets(DVec3::Y * place.y, toward);
            first_m.is_some_and(|first_m| first_m < out.length() + CLEARANCE_M)
        });
        if is_hidden {
            continue;
        }
        let share = if most > 0.0 { light.at(place) / most } else { 0.0 };
        if draw.unit() < 1.0 - by_light + by_light * share {
            places.push(place);
        }
    }
    Ok(places)
}
