// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A folder that is filled out of sight and appears when it is complete.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::WriteError;
use super::parents::{MadeFolders, parent};
use super::partial::{ENDING, LETTERS, hold, remove_dead};

/// A folder in the making. Dropped without [`OutputFolder::finish`], it leaves no trace.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    destination: PathBuf,
    partial: TempDir,
    /// Says that somebody is at work on it.
    _lock: Option<File>,
    /// Go after the folder in them.
    _made: MadeFolders,
}

impl OutputFolder {
    /// Begins a folder that will lie at `path`, or whose files will be added to the folder that lies there. Folders above it
    /// are made.
    ///
    /// # Errors
    /// Whatever would keep it from lying there.
    pub(crate) fn create(path: &Path) -> Result<Self, WriteError> {
        let fail = |reason: &str| WriteError::at(path)(io::Error::other(reason));
        if path.exists() && !path.is_dir() {
            return Err(fail("something that is not a folder lies there"));
        }
        let name = path.file_name().ok_or_else(|| fail("it does not name a folder"))?;
        let made = MadeFolders::make(parent(path)).map_err(WriteError::at(path))?;
        let mut prefix = OsString::from(".");
        prefix.push(name);
        prefix.push(".");
        remove_dead(parent(path), &prefix);
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(ENDING).rand_bytes(LETTERS);
        // Permissions of any other folder: the user's mask takes its bits away.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
        let (partial, lock) = loop {
            let partial = builder.tempdir_in(parent(path)).map_err(WriteError::at(path))?;
            // Only on Unix can a folder be opened, and only there is the lock needed.
            let lock = File::open(partial.path()).ok();
            if lock.as_ref().is_none_or(|lock| hold(lock, partial.path())) {
                break (partial, lock);
            }
        };
        Ok(Self { destination: path.to_owned(), partial, _lock: lock, _made: made })
    }

    /// Path to write to for now.
    pub(crate) fn partial(&self) -> &Path {
        self.partial.path()
    }

    /// Path that it will lie at.
    pub(crate) fn destination(&self) -> &Path {
        &self.destination
    }

    /// Moves everything to its place: the whole folder, or each file into the folder that lies there, the one named `last`
    /// after all others.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn finish(self, last: &str) -> Result<(), WriteError> {
        if !self.destination.exists() {
            return self.move_whole();
        }
        move_files(self.partial(), &self.destination, last)
    }

    /// Gives the whole folder its name.
    fn move_whole(mut self) -> Result<(), WriteError> {
        fs::rename(self.partial(), &self.destination).map_err(WriteError::at(&self.destination))?;
        // Nothing lies there any more.
        self.partial.disable_cleanup(true);
        Ok(())
    }
}

/// Moves each file of a folder into another one, that named `last` after all others.
///
/// # Errors
/// Errors of the system.
pub(super) fn move_files(from: &Path, to: &Path, last: &str) -> Result<(), WriteError> {
    let mut names = Vec::new();
    for entry in fs::read_dir(from).map_err(WriteError::at(to))? {
        names.push(entry.map_err(WriteError::at(to))?.file_name());
    }
    names.sort_by_key(|name| (name == last, name.clone()));
    // Found before anything has moved: a file does not replace a folder, which may hold anything.
    for name in &names {
        let path = to.join(name);
        if path.is_dir() && !from.join(name).is_dir() {
            return Err(WriteError::at(&path)(io::Error::other("something that is not a file lies there")));
        }
    }
    for name in names {
        let path = to.join(&name);
        if path.is_dir() {
            fs::remove_dir_all(&path).map_err(WriteError::at(&path))?;
        }
        fs::rename(from.join(&name), &path).map_err(WriteError::at(&path))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_added_but_replace_no_folder() {
        let there = tempfile::tempdir().expect("a temporary folder");
        let path = there.path().join("new/out");
        let begin = || {
            let folder = OutputFolder::create(&path).expect("writable");
            fs::write(folder.partial().join("a"), "a").expect("writable");
            fs::write(folder.partial().join("b"), "b").expect("writable");
            folder
        };
        drop(begin());
        assert_eq!(fs::read_dir(&there).expect("a folder").count(), 0, "nothing is left");
        begin().finish("").expect("renamed");
        fs::write(path.join("other"), "kept").expect("writable");
        begin().finish("").expect("added");
        assert_eq!(fs::read_dir(&path).expect("a folder").count(), 3, "beside what was there");
        fs::remove_file(path.join("a")).expect("there");
        fs::remove_file(path.join("b")).expect("there");
        fs::create_dir(path.join("b")).expect("writable");
        let error = begin().finish("").expect_err("a folder lies there").to_string();
        assert!(error.contains("not a file"), "{error}");
        assert!(!path.join("a").exists() && path.join("b").is_dir(), "nothing has moved");
    }
}
