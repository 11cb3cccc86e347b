// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faults of a folder of leaves.

use std::path::{Path, PathBuf};

/// A folder of leaves that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// A file that the folder should hold is not there.
    #[error("{}: no such file; a folder of leaves holds it", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// A file cannot be read.
    #[error("{}: cannot read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file cannot be written.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The manifest was written for another version of the program.
    #[error("{}: version is {found}, allowed: {allowed}", path.display())]
    Version {
        /// The manifest.
        path: PathBuf,
        /// Its version.
        found: u32,
        /// The version that can be read.
        allowed: u32,
    },
    /// The text of the manifest is none.
    #[error("{}:{line}:{column}: {problem}", path.display())]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The fault there.
        problem: String,
    },
    /// A value of the manifest is not allowed.
    #[error("{}: {field} is {value}, allowed: {allowed}", path.display())]
    Field {
        /// The manifest.
        path: PathBuf,
        /// The field.
        field: String,
        /// Its value.
        value: String,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A picture cannot be decoded.
    #[error("{}: no whole PNG picture: {problem}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// The decoder's reason.
        problem: String,
    },
    /// A picture has another size than the manifest says.
    #[error("{}: {}x{} pixels, allowed: {allowed}x{allowed}, as the manifest says", path.display(), found.0, found.1)]
    Size {
        /// The file.
        path: PathBuf,
        /// Its width and height.
        found: (u32, u32),
        /// The side that the manifest gives.
        allowed: u32,
    },
}

impl FolderError {
    /// A read that failed.
    pub(super) fn read(path: &Path, source: std::io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            std::io::ErrorKind::NotFound => Self::Missing { path },
            _ => Self::Read { path, source },
        }
    }

    /// A write that failed.
    pub(super) fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }
}
