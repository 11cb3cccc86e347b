// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ground on which leaves land.

use serde::{Deserialize, Serialize};

use super::{Litter, Terrain, Water};

/// A level plane, or hills; with or without water.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ground {
    /// Height of the plane, or of hilly ground at the origin, in metres, -4096 to 4096.
    pub height_m: f32,
    /// Coulomb friction coefficient between leaf and ground, 0.05 to 5: dry grass 0.4 to 0.6, wet 0.8.
    pub friction: f32,
    /// Roughness length in metres that the wind meets below one metre, 0.0001 to 0.1: paved areas 0.0002 (Stull, "Meteorology for
    /// Scientists and Engineers"), short grass 0.008 to 0.02, long grass 0.02 to 0.06 (Brutsaert, "Hydrology", table 2.6). The
    /// default, 0.005, is assumed for a mown lawn.
    pub surface_roughness_m: f32,
    /// Hills.
    pub terrain: Option<Terrain>,
    /// Water: what of the ground lies lower is under it.
    pub water: Option<Water>,
    /// Leaves that pile up and blow on.
    pub litter: Option<Litter>,
}

impl Default for Ground {
    fn default() -> Self {
        Self {
            height_m: 0.0,
            friction: 0.5,
            surface_roughness_m: 0.005,
            terrain: None,
            water: None,
            litter: None,
        }
    }
}
