// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors, in one clear line each.

use std::path::PathBuf;

use thiserror::Error;

/// A scene, motion table file or checkpoint that cannot be used as it is.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A value outside what is allowed.
    #[error("{file}: {field} is {value}; allowed: {allowed}")]
    Field {
        /// File or preset the value stands in.
        file: String,
        /// Path of the field, such as `sources[0].count`.
        field: String,
        /// The value found.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// Text that is not the expected format.
    #[error("{file}:{line}:{column}: {message}")]
    Syntax {
        /// File the text stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Fault.
        message: String,
    },
    /// Neither a preset nor a readable file.
    #[error("scene '{name}' is neither a file nor a preset{}; presets: {presets}", did_you_mean(*.nearest))]
    UnknownScene {
        /// Request.
        name: String,
        /// The preset that was probably meant.
        nearest: Option<&'static str>,
        /// Names of all presets.
        presets: String,
    },
    /// A file that cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Bytes that are not a checkpoint this version can read.
    #[error("{file}: not a usable checkpoint: {reason}")]
    Checkpoint {
        /// File or stream the bytes came from.
        file: String,
        /// Fault, and the expectation.
        reason: String,
    },
}

impl SceneError {
    /// The same error, of a scene that a file or preset stands for: those found when a scene is compiled name the scene.
    #[must_use]
    pub(crate) fn of_file(self, scene: &str, file: &str) -> Self {
        match self {
            Self::Field { file: named, field, value, allowed } if named == scene => {
                Self::Field { file: file.into(), field, value, allowed }
            }
            other => other,
        }
    }
}

/// A simulator that cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SimError {
    /// A larger store than the device can hold.
    #[error("{rows} {store} need {needed} bytes in one buffer; {device} allows {allowed}")]
    Capacity {
        /// Name of what the store's rows are.
        store: &'static str,
        /// Rows asked for.
        rows: usize,
        /// Bytes that the largest buffer would take.
        needed: u64,
        /// Bytes that the device allows.
        allowed: u64,
        /// The device.
        device: String,
    },
    /// A world of another size than the simulator was made for.
    #[error(
        "world has {world} {store}, simulator {simulator}; make a new simulator for a world of another size"
    )]
    Size {
        /// Name of what the store's rows are.
        store: &'static str,
        /// Rows of the world.
        world: usize,
        /// Rows of the simulator.
        simulator: usize,
    },
    /// The device went away; the state since the last read is lost.
    #[error("device lost: {reason}")]
    DeviceLost {
        /// The driver's reason.
        reason: String,
    },
    /// The device refused something; a bug of ours or of the driver.
    #[error("device error: {reason}")]
    Device {
        /// The driver's reason.
        reason: String,
    },
    /// No adapter fits.
    #[error("no usable adapter: {reason}")]
    NoAdapter {
        /// Request, finding and remedy.
        reason: String,
    },
}

/// A hint to append to a line.
fn did_you_mean(name: Option<&str>) -> String {
    name.map(|name| format!(" (did you mean '{name}'?)")).unwrap_or_default()
}
