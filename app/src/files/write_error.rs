// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Error of writing.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A path that cannot be written.
#[derive(Debug, Error)]
#[error("{}: cannot write: {reason}", path.display())]
pub(crate) struct WriteError {
    path: PathBuf,
    reason: io::Error,
}

impl WriteError {
    /// For `map_err`: an error while writing `path`.
    pub(crate) fn at(path: &Path) -> impl Fn(io::Error) -> Self {
        move |reason| Self { path: path.to_owned(), reason }
    }
}
