// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A file or directory that is written beside its destination and takes its name when complete.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::OutputError;

/// A path beside the destination; removed on drop unless it was put in place.
#[derive(Debug)]
pub(crate) struct Beside {
    destination: PathBuf,
    partial: PathBuf,
    /// Directories that had to be made, the outermost first.
    made: Vec<PathBuf>,
}

impl Beside {
    /// Makes the parent directories of `destination` and an empty file beside it, ending in `extension`.
    pub(crate) fn file(destination: &Path, extension: &str) -> Result<Self, OutputError> {
        let beside = Self::prepare(destination, extension)?;
        fs::File::create(&beside.partial).map_err(OutputError::write(destination))?;
        Ok(beside)
    }

    /// The same for a directory.
    pub(crate) fn directory(destination: &Path) -> Result<Self, OutputError> {
        let beside = Self::prepare(destination, "d")?;
        fs::create_dir(&beside.partial).map_err(OutputError::write(destination))?;
        Ok(beside)
    }

    fn prepare(destination: &Path, extension: &str) -> Result<Self, OutputError> {
        let parent = destination.parent().filter(|parent| !parent.as_os_str().is_empty());
        let parent = parent.unwrap_or(Path::new("."));
        let mut made: Vec<_> =
            parent.ancestors().take_while(|path| !path.exists()).map(Path::to_owned).collect();
        made.retain(|path| !path.as_os_str().is_empty());
        made.reverse();
        let mut name = OsString::from(".");
        name.push(destination.file_name().unwrap_or_default());
        name.push(format!(".{}.partial.{extension}", std::process::id()));
        let partial = parent.join(name);
        // From here on dropping it undoes what was done.
        let beside = Self { destination: destination.to_owned(), partial, made };
        fs::create_dir_all(parent).map_err(OutputError::write(destination))?;
        Ok(beside)
    }

    /// Where to write for now.
    pub(crate) fn partial(&self) -> &Path {
        &self.partial
    }

    /// Where the result will lie.
    pub(crate) fn destination(&self) -> &Path {
        &self.destination
    }

    /// Gives the finished file its name.
    pub(crate) fn put_in_place(&self) -> Result<(), OutputError> {
        fs::rename(&self.partial, &self.destination).map_err(OutputError::write(&self.destination))
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // After a rename nothing lies there any more, and there is nobody to tell about a failure.
        if self.partial.is_dir() {
            let _ = fs::remove_dir_all(&self.partial);
        } else {
            let _ = fs::remove_file(&self.partial);
        }
        // Keeps those with something in them.
        for directory in self.made.iter().rev() {
            let _ = fs::remove_dir(directory);
        }
    }
}
