// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A folder that is filled out of sight and appears when it is complete.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::anyhow;

use crate::files::write_error;

/// A folder in the making. Dropped without [`OutputFolder::finish`], it leaves no trace.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    destination: PathBuf,
    partial: PathBuf,
    /// Folders above it that had to be made, the outermost first.
    made: Vec<PathBuf>,
}

impl OutputFolder {
    /// Begins a folder that will lie at `path`, or whose files will be added to the folder that lies there.
    ///
    /// # Errors
    /// Whatever would keep it from lying there, named with the path.
    pub(crate) fn create(path: &Path) -> anyhow::Result<Self> {
        if path.exists() && !path.is_dir() {
            return Err(anyhow!(
                "{}: cannot write: something that is not a folder lies there",
                path.display()
            ));
        }
        let name = path
            .file_name()
            .ok_or_else(|| anyhow!("{}: cannot write: it does not name a folder", path.display()))?;
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut made: Vec<PathBuf> =
            parent.ancestors().take_while(|path| !path.exists()).map(Path::to_owned).collect();
        made.retain(|path| !path.as_os_str().is_empty());
        made.reverse();
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.partial", std::process::id()));
        let folder = Self { destination: path.to_owned(), partial: parent.join(hidden), made };
        fs::create_dir_all(&folder.partial).map_err(|error| write_error(path, &error))?;
        Ok(folder)
    }

    /// Where to write for now.
    pub(crate) fn partial(&self) -> &Path {
        &self.partial
    }

    /// Moves everything to its place: the whole folder, or each file into the folder that lies there, those named in
    /// `last` after all others.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(crate) fn finish(self, last: &str) -> anyhow::Result<()> {
        if !self.destination.exists() {
            return fs::rename(&self.partial, &self.destination)
                .map_err(|error| write_error(&self.destination, &error));
        }
        let mut names = Vec::new();
        for entry in fs::read_dir(&self.partial).map_err(|error| write_error(&self.destination, &error))? {
            names.push(entry.map_err(|error| write_error(&self.destination, &error))?.file_name());
        }
        names.sort_by_key(|name| (name == last, name.clone()));
        for name in names {
            let path = self.destination.join(&name);
            if path.is_dir() {
                fs::remove_dir_all(&path).map_err(|error| write_error(&path, &error))?;
            }
            fs::rename(self.partial.join(&name), &path).map_err(|error| write_error(&path, &error))?;
        }
        Ok(())
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        // After a renaming nothing lies there any more, and there is nobody to tell about a failure.
        let _ = fs::remove_dir_all(&self.partial);
        for folder in self.made.iter().rev() {
            // Keeps those with something in them.
            let _ = fs::remove_dir(folder);
        }
    }
}
