// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors of outputs.

use std::path::PathBuf;

use thiserror::Error;

use crate::files::WriteError;

/// An output that cannot be written. Every message names the path.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum OutputError {
    /// An extension no writer knows.
    #[error("{}: unknown kind of output; allowed: a .png, .gif or .mp4 file, or a directory", path.display())]
    UnknownFormat {
        /// The path asked for.
        path: PathBuf,
    },
    /// A path that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A picture the encoder refused.
    #[error("{}: cannot encode: {reason}", path.display())]
    Encode {
        /// The path asked for.
        path: PathBuf,
        /// The encoder's reason.
        reason: String,
    },
    /// A size the format cannot hold.
    #[error("{}: {width}x{height} pixels; {allowed}", path.display())]
    Size {
        /// The path asked for.
        path: PathBuf,
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Sizes that the format allows.
        allowed: &'static str,
    },
    /// A frame rate that is none.
    #[error("{}: {fps} frames per second; allowed: more than 0 to 1000", path.display())]
    FrameRate {
        /// The path asked for.
        path: PathBuf,
        /// The rate asked for.
        fps: f64,
    },
    /// A frame of another size than the clip.
    #[error("{}: a frame of {found:?} pixels in a clip of {expected:?}", path.display())]
    FrameSize {
        /// The path asked for.
        path: PathBuf,
        /// Size of the clip.
        expected: (u32, u32),
        /// Size of the frame.
        found: (u32, u32),
    },
    /// A clip without frames.
    #[error("{}: no frame was drawn; nothing was written", path.display())]
    NoFrames {
        /// The path asked for.
        path: PathBuf,
    },
    /// ffmpeg is not installed.
    #[error(
        "{}: mp4 needs ffmpeg, and no program of that name is on the PATH; install it (Debian, Ubuntu: \
         apt install ffmpeg) or write a .gif or a directory of .png files",
        path.display()
    )]
    NoFfmpeg {
        /// The path asked for.
        path: PathBuf,
    },
    /// ffmpeg failed.
    #[error("{}: ffmpeg failed: {reason}", path.display())]
    Ffmpeg {
        /// The path asked for.
        path: PathBuf,
        /// Its last messages.
        reason: String,
    },
}
