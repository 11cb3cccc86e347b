// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A falling piece at a moment.

use glam::{DQuat, DVec3};
use plotters::style::RGBColor;
use serde::Serialize;
use windfall_core::World;
use windfall_core::device::leaf::record::leaf_regime;

/// How a piece falls, as the simulation labels it from its latest turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Regime {
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
}

impl Regime {
    /// All of them, in the order of their numbers.
    pub(super) const ALL: [Self; 6] =
        [Self::Steady, Self::Flutter, Self::Tumble, Self::Chaotic, Self::Helical, Self::Spiral];

    /// What it is called.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::Flutter => "flutter",
            Self::Tumble => "tumble",
            Self::Chaotic => "chaotic",
            Self::Helical => "helical",
            Self::Spiral => "spiral",
        }
    }
}

/// The colour of a regime.
pub(super) fn color(regime: Regime) -> RGBColor {
    match regime {
        Regime::Steady => RGBColor(120, 132, 140),
        Regime::Flutter => RGBColor(44, 124, 176),
        Regime::Tumble => RGBColor(222, 142, 28),
        Regime::Chaotic => RGBColor(186, 60, 48),
        Regime::Helical => RGBColor(62, 138, 84),
        Regime::Spiral => RGBColor(126, 84, 162),
    }
}

/// One number for every regime.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct PerRegime {
    pub(super) steady: f64,
    pub(super) flutter: f64,
    pub(super) tumble: f64,
    pub(super) chaotic: f64,
    pub(super) helical: f64,
    pub(super) spiral: f64,
}

impl PerRegime {
    /// From numbers in the order of [`Regime::ALL`].
    pub(super) fn from_array([steady, flutter, tumble, chaotic, helical, spiral]: [f64; 6]) -> Self {
        Self { steady, flutter, tumble, chaotic, helical, spiral }
    }

    /// The numbers in the order of [`Regime::ALL`].
    pub(super) fn to_array(self) -> [f64; 6] {
        [self.steady, self.flutter, self.tumble, self.chaotic, self.helical, self.spiral]
    }
}

/// A falling piece at a moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Seconds since the release.
    pub(super) time_s: f64,
    /// Centre of mass, in metres above the ground.
    pub(super) position_m: DVec3,
    /// Turns the piece's normal, +y, and its length, +z, into place.
    pub(super) attitude: DQuat,
    /// Velocity of the centre of mass in m/s.
    pub(super) velocity_m_s: DVec3,
    /// How it falls.
    pub(super) regime: Regime,
}

impl Sample {
    /// Of a slot whose leaf falls.
    pub(super) fn of(world: &World, slot: usize) -> Self {
        let place = &world.leaves.place[slot];
        let number = leaf_regime(place.bits) as usize;
        Self {
            time_s: world.clock.seconds(),
            position_m: DVec3::from(place.position.map(f64::from)),
            attitude: DQuat::from_array(world.leaves.attitude[slot].quaternion.map(f64::from)),
            velocity_m_s: DVec3::from(world.leaves.drift[slot].velocity.map(f64::from)),
            regime: Regime::ALL.get(number).copied().unwrap_or(Regime::Steady),
        }
    }
}
