// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hills and water.

use serde::{Deserialize, Serialize};

/// Hills by midpoint subdivision: a square that repeats in both directions, so that it has no edge to fall off.
///
/// # Source
/// Ground modelling of Bostandjiev, Kovaleva and Vaquero, "3D real-time plants modeling with L-systems": opposite corners
/// offset, midpoints as means, a little offset for every new point, a big one for some, a smoothing filter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Terrain {
    /// Seed of the hills, any number. The scene's own seed does not move them.
    pub seed: u64,
    /// Edge of the square in metres, 16 to 4096. Hollows and hills are about half an edge apart, and a hollow lies near
    /// the origin.
    pub edge_m: f32,
    /// Height of the highest point above the lowest in metres, 0 to 500.
    pub relief_m: f32,
    /// Halvings of the square, 2 to 9: cells along its edge are two to this power.
    pub levels: u32,
    /// Largest little offset of a new point, relative to the corners' offset halved at every level, 0 to 1.
    pub noise: f32,
    /// Share of new points that are pulled up by a big offset, up to the corners' halved at every level, 0 to 1.
    pub pulled: f32,
    /// Passes of the smoothing filter after every halving, 0 to 8: 0 leaves every edge, 1 gives rolling hills.
    pub smoothing: u32,
}

impl Default for Terrain {
    fn default() -> Self {
        Self { seed: 1, edge_m: 256.0, relief_m: 12.0, levels: 8, noise: 0.3, pulled: 0.1, smoothing: 1 }
    }
}

/// Still water. Leaves that come down on it stay on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// Height of its surface in metres, -4096 to 4096.
    pub height_m: f32,
}
