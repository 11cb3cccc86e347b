// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Folders above a destination.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Folder that a destination lies in.
pub(super) fn parent(destination: &Path) -> &Path {
    destination.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Folders that had to be made, the outermost first. Those that are empty when this is dropped are removed again.
#[derive(Debug, Default)]
pub(super) struct MadeFolders(Vec<PathBuf>);

impl MadeFolders {
    /// Makes `folder` and all above it.
    pub(super) fn make(folder: &Path) -> io::Result<Self> {
        let mut made: Vec<_> =
            folder.ancestors().take_while(|path| !path.exists()).map(Path::to_owned).collect();
        made.retain(|path| !path.as_os_str().is_empty());
        made.reverse();
        // From here on dropping it undoes what was done.
        let made = Self(made);
        fs::create_dir_all(folder)?;
        Ok(made)
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            // Keeps those with something in them.
            let _ = fs::remove_dir(folder);
        }
    }
}
