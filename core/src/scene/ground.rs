// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What leaves land on.

use serde::{Deserialize, Serialize};

/// A level ground plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ground {
    /// Height of the plane in metres, -4096 to 4096.
    pub height_m: f32,
    /// Coulomb friction coefficient between leaf and ground, 0.05 to 5: dry grass 0.4 to 0.6, wet 0.8.
    pub friction: f32,
}

impl Default for Ground {
    fn default() -> Self {
        Self { height_m: 0.0, friction: 0.5 }
    }
}
