// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow that has lain for hours before time zero.

use crate::blocks::StepBlock;
use crate::compile::CompiledScene;
use crate::convert::word;
use crate::device::terrain::snow::{SNOW_AGES, SNOW_INTERVAL, SNOW_TURNS};
use crate::litter::Bed;

/// Rounds an hour in which snow lies before time zero: short enough that little of it drifts in each.
const ROUNDS_PER_H: f64 = 240.0;

/// Rounds of steps in so many hours.
pub(super) fn rounds_of(compiled: &CompiledScene, hours: f64) -> f64 {
    3600.0 * hours / (f64::from(SNOW_INTERVAL * SNOW_TURNS) * f64::from(compiled.scene().dt_s))
}

/// Lets the snow of a world lie for so many hours, in the wind and the air of a step.
pub(super) fn lie(compiled: &CompiledScene, step: &StepBlock, bed: &mut Bed, hours: f64) {
    let rounds = word(libm::ceil(hours * ROUNDS_PER_H));
    for round in 0..rounds {
        let step = compiled.lying_step(step, round, 3600.0 * hours / f64::from(rounds));
        let cx = compiled.context(&step);
        let mut snow = bed.snow_mut(cx.scene);
        for turn in 0..SNOW_AGES {
            snow.exchange_around(&cx, turn);
            snow.exchange(&cx, turn);
        }
        snow.age(&cx);
    }
}
