// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faults of trees that grow towards light.

use thiserror::Error;

#[cfg(feature = "gltf")]
use crate::surface::SurfaceError;
#[cfg(feature = "gltf")]
use crate::tree::gltf::GltfError;

/// Ground for a tree not to grow into its hull.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A hull that is a file, though glTF files cannot be read in this build.
    #[error("the hull '{file}' needs the feature \"gltf\" of windfall-core")]
    NoGltf {
        /// The file.
        file: String,
    },
    /// A hull that cannot be read.
    #[cfg(feature = "gltf")]
    #[error("the hull {source}")]
    Gltf {
        /// Fault.
        source: Box<GltfError>,
    },
    /// A hull that is not closed, or has no volume.
    #[cfg(feature = "gltf")]
    #[error("the hull {file} {source}; allowed: {}", source.allowed())]
    Surface {
        /// The file.
        file: String,
        /// Fault.
        source: SurfaceError,
    },
    /// A hull in the ground, or of a size that no tree has.
    #[error(
        "the hull {file} reaches from {low_m} to {high_m} m; allowed: from 0 m or more up to 0.2 to 60 m, and 30 m aside"
    )]
    Size {
        /// The file.
        file: String,
        /// Height of its lowest point in metres.
        low_m: f64,
        /// Height of its highest point in metres.
        high_m: f64,
    },
    /// A hull too thin or too dark for all births.
    #[error(
        "{found} of {wanted} births found a place; allowed: a hull with more room and light in the box around it, or fewer"
    )]
    Births {
        /// Number of births that found a place.
        found: u32,
        /// Number wanted.
        wanted: u32,
    },
}
