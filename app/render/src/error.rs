// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors of drawing.

use thiserror::Error;

use crate::light::MapError;

/// A renderer that cannot be made or a picture that cannot be read back.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A picture larger or smaller than the device can draw.
    #[error("picture of {width}x{height} pixels; this device draws 1x1 to {limit}x{limit}")]
    Size {
        /// Width asked for in pixels.
        width: u32,
        /// Height asked for in pixels.
        height: u32,
        /// Largest edge the device allows.
        limit: u32,
    },
    /// More leaf images than one texture array holds.
    #[error(
        "{layers} leaf images; this device holds {limit} in one texture array: use fewer species or variants"
    )]
    Layers {
        /// Images asked for.
        layers: usize,
        /// Images the device allows.
        limit: u32,
    },
    /// Leaf images that do not belong together.
    #[error("leaf images: {0}")]
    Images(String),
    /// A picture of a sky that cannot be used.
    #[error(transparent)]
    Sky(#[from] MapError),
    /// A picture that could not be read back.
    #[error("cannot read the picture back from the device: {0}")]
    Readback(String),
}
