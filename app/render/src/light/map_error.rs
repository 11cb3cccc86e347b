// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors of pictures that are to light a scene.

use thiserror::Error;

/// A file that is no usable picture of a sky.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapError {
    /// A file that cannot be read.
    #[error("{file}: {source}")]
    Read {
        /// The file.
        file: String,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file of another kind.
    #[error("{file}: neither a Radiance (.hdr) nor an OpenEXR (.exr) picture; allowed: one of these")]
    Kind {
        /// The file.
        file: String,
    },
    /// A file that ends too early or makes no sense.
    #[error(
        "{file}: broken or cut off ({source}); allowed: a whole Radiance or OpenEXR picture with red, green and blue"
    )]
    Broken {
        /// The file.
        file: String,
        /// Error of the decoder.
        source: image::ImageError,
    },
    /// More bytes than any allowed picture has.
    #[error("{file}: {length} bytes; allowed: at most {allowed}")]
    Bytes {
        /// The file.
        file: String,
        /// Bytes found.
        length: u64,
        /// Most bytes.
        allowed: u64,
    },
    /// Too many pixels or too few.
    #[error("{file}: {width}x{height} pixels; allowed: at least 8 rows, at most 8192x4096 = 33554432 pixels")]
    Size {
        /// The file.
        file: String,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Sides that no map has.
    #[error(
        "{file}: {width}x{height} pixels; allowed: 2:1 by latitude and longitude, or a cube as a cross, 3:4 upright or 4:3 lying"
    )]
    Aspect {
        /// The file.
        file: String,
        /// Width in pixels.
        width: u64,
        /// Height in pixels.
        height: u64,
    },
    /// A pixel that is no light.
    #[error("{file}: the pixel in column {x}, row {y} has the value {value}; allowed: 0 to 1e9")]
    Value {
        /// The file.
        file: String,
        /// Column, from 0.
        x: usize,
        /// Row, from 0.
        y: usize,
        /// The value.
        value: f32,
    },
    /// No light at all.
    #[error("{file}: black all over; allowed: a picture with some light")]
    Black {
        /// The file.
        file: String,
    },
}
