// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A falling piece at a moment.

use glam::{DQuat, DVec3};
use windfall_core::World;
use windfall_core::device::leaf::record::leaf_regime;

use super::regime::Regime;

/// A falling piece at a moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Seconds since the release.
    pub(crate) time_s: f64,
    /// Centre of mass, in metres above the ground.
    pub(crate) position_m: DVec3,
    /// Turns the piece's normal, +y, and its length, +z, into place.
    pub(crate) attitude: DQuat,
    /// Velocity of the centre of mass in m/s.
    pub(crate) velocity_m_s: DVec3,
    /// Regime of its fall.
    pub(crate) regime: Regime,
}

impl Sample {
    /// Of a slot whose leaf falls.
    pub(crate) fn of(world: &World, slot: usize) -> Self {
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
