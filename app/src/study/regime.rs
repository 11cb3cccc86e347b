// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Regimes of falling bodies.

use serde::Serialize;
use windfall_core::device::flight::regime::{REGIME_COUNT, REGIME_NAMES};

/// Number of regimes.
pub(crate) const COUNT: usize = REGIME_COUNT as usize;

/// Regime of a falling body, as the simulation classifies it from its latest turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Regime {
    /// Hardly turns nor swings.
    Steady,
    /// Swings to and fro, the same side up.
    Flutter,
    /// Turns over and over, the same way.
    Tumble,
    /// Now turns over, now swings, now turns the other way.
    Chaotic,
    /// Swings while its heading goes round.
    Helical,
    /// Hardly swings while its heading goes round.
    Spiral,
    /// Goes round the direction of its fall, as a winged seed does.
    Autorotation,
}

impl Regime {
    /// All of them, in the order of their numbers.
    pub(crate) const ALL: [Self; COUNT] = [
        Self::Steady,
        Self::Flutter,
        Self::Tumble,
        Self::Chaotic,
        Self::Helical,
        Self::Spiral,
        Self::Autorotation,
    ];

    /// Name in reports.
    pub(crate) fn name(self) -> &'static str {
        REGIME_NAMES[self as usize]
    }
}

/// One number for every regime.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct PerRegime {
    pub(crate) steady: f64,
    pub(crate) flutter: f64,
    pub(crate) tumble: f64,
    pub(crate) chaotic: f64,
    pub(crate) helical: f64,
    pub(crate) spiral: f64,
    pub(crate) autorotation: f64,
}

impl PerRegime {
    /// From numbers in the order of [`Regime::ALL`].
    pub(crate) fn from_array(numbers: [f64; COUNT]) -> Self {
        let [steady, flutter, tumble, chaotic, helical, spiral, autorotation] = numbers;
        Self { steady, flutter, tumble, chaotic, helical, spiral, autorotation }
    }

    /// The numbers in the order of [`Regime::ALL`].
    pub(crate) fn to_array(self) -> [f64; COUNT] {
        let Self { steady, flutter, tumble, chaotic, helical, spiral, autorotation } = self;
        [steady, flutter, tumble, chaotic, helical, spiral, autorotation]
    }
}
