// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors of the page, a line each.

use thiserror::Error;
use windfall_core::{SceneError, SimError};
use windfall_render::RenderError;
use windfall_render::light::MapError;
use windfall_texgen::{PackError, TexgenError};

/// Reasons why the page cannot do what it was asked for. It goes on as it was.
#[derive(Debug, Error)]
pub enum WebError {
    /// A scene that cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A simulator that cannot go on.
    #[error(transparent)]
    Sim(#[from] SimError),
    /// A picture that cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A sky that cannot be used.
    #[error(transparent)]
    Sky(#[from] MapError),
    /// Leaves that cannot be painted.
    #[error(transparent)]
    Leaves(#[from] TexgenError),
    /// A scene that names a file of the reader's disk.
    #[error(
        "{file}: names the file '{named}'; allowed: none but a sky, as a page reads no files beside a scene"
    )]
    NamedFile {
        /// Name of the scene.
        file: String,
        /// Name of the file.
        named: String,
    },
    /// More memory than a page has.
    #[error(
        "{file}: leaves and particles need {needed} MiB; allowed: {allowed} MiB, of which a page has no more"
    )]
    Memory {
        /// Name of the scene.
        file: String,
        /// MiB needed.
        needed: u64,
        /// MiB allowed.
        allowed: u64,
    },
    /// A camera that is none.
    #[error("camera: {field} is {value}; allowed: {allowed}")]
    Camera {
        /// Number of the camera.
        field: &'static str,
        /// The value found.
        value: f32,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A pack of leaves that cannot be read.
    #[error("{file}: {error}")]
    LeafPack {
        /// Name of the pack.
        file: String,
        /// The part that is broken.
        error: PackError,
    },
    /// No device to draw with.
    #[error("WebGPU: {reason}; allowed: a browser and a graphics driver that have it")]
    NoDevice {
        /// The browser's reason.
        reason: String,
    },
}
