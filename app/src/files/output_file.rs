// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A file that is written beside its destination and takes its name when complete.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::anyhow;

/// A file in the making. Dropped without [`OutputFile::finish`], it leaves no trace, and what lay at its destination
/// stays as it was.
#[derive(Debug)]
pub(crate) struct OutputFile {
    destination: PathBuf,
    partial: PathBuf,
    file: File,
}

impl OutputFile {
    /// Begins a file that will lie at `path`.
    ///
    /// # Errors
    /// Whatever would keep it from lying there, named with the path.
    pub(crate) fn create(path: &Path) -> anyhow::Result<Self> {
        let fail = |reason: &dyn std::fmt::Display| anyhow!("{}: cannot write: {reason}", path.display());
        // A link stays a link; devices, pipes and folders must not be replaced by a file.
        let destination = match path.canonicalize() {
            Ok(there) if there.is_file() => there,
            Ok(_) => return Err(fail(&"something that is not a file lies there")),
            Err(_) => path.to_owned(),
        };
        let name = destination.file_name().ok_or_else(|| fail(&"it does not name a file"))?;
        let folder = destination.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(fail(&format!("there is no folder {}", folder.display())));
        }
        let mut partial = OsString::from(".");
        partial.push(name);
        partial.push(format!(".{}.partial", std::process::id()));
        let partial = folder.join(partial);
        let file = File::create(&partial).map_err(|error| fail(&error))?;
        Ok(Self { destination, partial, file })
    }

    /// Where it will lie.
    pub(crate) fn destination(&self) -> &Path {
        &self.destination
    }

    /// Brings the file to the disk and gives it its name.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(crate) fn finish(mut self) -> anyhow::Result<()> {
        let done = self.file.flush().and_then(|()| self.file.sync_all());
        done.and_then(|()| fs::rename(&self.partial, &self.destination))
            .map_err(|error| write_error(&self.destination, &error))
    }
}

/// An error of writing, named with the path.
pub(crate) fn write_error(path: &Path, error: &io::Error) -> anyhow::Error {
    anyhow!("{}: cannot write: {error}", path.display())
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for OutputFile {
    fn drop(&mut self) {
        // After the renaming nothing lies there any more, and there is nobody to tell about a failure.
        let _ = fs::remove_file(&self.partial);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_finished_files_appear() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        let mut file = OutputFile::create(&path).expect("writable");
        file.write_all(b"old").expect("room");
        assert!(!path.exists(), "not yet");
        file.finish().expect("renamed");
        let mut file = OutputFile::create(&path).expect("writable");
        file.write_all(b"new").expect("room");
        drop(file);
        assert_eq!(fs::read(&path).expect("readable"), b"old", "an unfinished file changes nothing");
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1, "nothing else is left");
    }

    #[test]
    fn impossible_places_are_refused_at_once() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let inside = folder.path().join("missing").join("a.txt");
        let error = OutputFile::create(&inside).expect_err("no such folder").to_string();
        assert!(error.contains("there is no folder") && error.contains("missing"), "{error}");
        let error = OutputFile::create(folder.path()).expect_err("a folder").to_string();
        assert!(error.contains("not a file"), "{error}");
        assert!(OutputFile::create(Path::new("")).is_err(), "nothing");
        assert!(OutputFile::create(Path::new("..")).is_err(), "no name");
    }
}
