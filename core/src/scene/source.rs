// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places and times of release of leaves.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Volume that leaves start from, uniformly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SourceShape {
    /// An axis-aligned box.
    Box {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Half edge lengths in metres, each 0 to 4096.
        half_extent_m: Vec3,
    },
    /// A horizontal disc.
    Disc {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
    },
    /// A ball.
    Sphere {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
    },
}

/// Times at which a source releases its leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Release {
    /// All at once.
    Burst {
        /// Time of release in seconds, 0 to 86400.
        at_s: f32,
    },
    /// One after another.
    Rate {
        /// Leaves per second, 0.001 to 100000000.
        per_s: f32,
        /// Time of the first release in seconds, -3600 to 86400. Leaves released before time zero begin where a
        /// fall through still air would have brought them by then, on the ground if it is over.
        from_s: f32,
    },
}

/// Part of a source's leaves that belong to one species.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Share {
    /// Name of the species.
    pub species: String,
    /// Weight relative to the other shares, 1 to 1000.
    pub weight: u32,
}

/// A place that leaves fall from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    /// Volume that leaves start from, nowhere below the ground.
    pub shape: SourceShape,
    /// Number of leaf slots, 1 to 1073741824; the same holds for the sum over all sources.
    pub count: u32,
    /// Times of release.
    pub release: Release,
    /// Seconds from a leaf's release until its slot is released again, 0.1 to 86400; `None` leaves every leaf where
    /// it lands for ever.
    pub recycle_after_s: Option<f32>,
    /// Species of the leaves, each at most once; all species of the scene alike when empty.
    pub species: Vec<Share>,
}

impl Default for Source {
    fn default() -> Self {
        Self {
            shape: SourceShape::Box {
                center_m: Vec3::new(0.0, 7.0, 0.0),
                half_extent_m: Vec3::new(6.0, 2.0, 6.0),
            },
            count: 1000,
            release: Release::Rate { per_s: 50.0, from_s: -10.0 },
            recycle_after_s: Some(20.0),
            species: Vec::new(),
        }
    }
}
