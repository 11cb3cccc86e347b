// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A file that is written beside its destination and takes its name when complete.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use image::codecs::png::PngEncoder;
use image::{ImageBuffer, PixelWithColorType};
use tempfile::NamedTempFile;

use super::WriteError;
use super::parents::{MadeFolders, parent};
use super::partial::{ENDING, LETTERS, hold, remove_dead};

/// A file in the making. Dropped without [`OutputFile::finish`], it leaves no trace, and what lay at its destination
/// stays as it was.
#[derive(Debug)]
pub(crate) struct OutputFile {
    destination: PathBuf,
    partial: NamedTempFile,
    /// Goes after the file in them.
    _made: MadeFolders,
}

impl OutputFile {
    /// Begins a file that will lie at `path`, in a folder that is there.
    ///
    /// # Errors
    /// Whatever would keep it from lying there.
    pub(crate) fn create(path: &Path) -> Result<Self, WriteError> {
        let fail = |reason: String| WriteError::at(path)(io::Error::other(reason));
        // A link stays a link; devices, pipes and folders must not be replaced by a file.
        let destination = match path.canonicalize() {
            Ok(there) if there.is_file() => there,
            Ok(_) => return Err(fail("something that is not a file lies there".into())),
            Err(_) => path.to_owned(),
        };
        let name = destination.file_name().ok_or_else(|| fail("it does not name a file".into()))?;
        let folder = parent(&destination);
        if !folder.is_dir() {
            return Err(fail(format!("there is no folder {}", folder.display())));
        }
        let mut prefix = OsString::from(".");
        prefix.push(name);
        prefix.push(".");
        remove_dead(folder, &prefix);
        // Other programs take the format from the ending.
        let mut suffix = OsString::from(ENDING);
        if let Some(ending) = destination.extension() {
            suffix.push(".");
            suffix.push(ending);
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(&suffix).rand_bytes(LETTERS);
        // Permissions of any other file: the user's mask takes its bits away.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let partial = loop {
            let partial = builder.tempfile_in(folder).map_err(WriteError::at(path))?;
            if hold(partial.as_file(), partial.path()) {
                break partial;
            }
        };
        Ok(Self { destination, partial, _made: MadeFolders::default() })
    }

    /// Begins a file that will lie at `path`, whose folders are made if they are not there.
    ///
    /// # Errors
    /// Whatever would keep it from lying there.
    pub(crate) fn create_with_folders(path: &Path) -> Result<Self, WriteError> {
        let made = MadeFolders::make(parent(path)).map_err(WriteError::at(path))?;
        Ok(Self { _made: made, ..Self::create(path)? })
    }

    /// Writes a whole file at once.
    ///
    /// # Errors
    /// Whatever keeps it from lying there.
    pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
        let mut file = Self::create(path)?;
        file.write_all(bytes).map_err(WriteError::at(path))?;
        file.finish()
    }

    /// A nameless file on the same disk, gone when it is closed.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn scratch(&self) -> Result<File, WriteError> {
        tempfile::tempfile_in(parent(&self.destination)).map_err(WriteError::at(&self.destination))
    }

    /// Path to write to for now.
    pub(crate) fn partial(&self) -> &Path {
        self.partial.path()
    }

    /// Path that it will lie at.
    pub(crate) fn destination(&self) -> &Path {
        &self.destination
    }

    /// Writes a picture as PNG and completes the file.
    ///
    /// # Errors
    /// Errors of the encoder or the system.
    pub(crate) fn finish_png<P>(mut self, picture: &ImageBuffer<P, Vec<u8>>) -> Result<(), WriteError>
    where
        P: PixelWithColorType<Subpixel = u8>,
    {
        let encoded = picture.write_with_encoder(PngEncoder::new(BufWriter::new(&mut self)));
        encoded.map_err(|error| WriteError::at(&self.destination)(io::Error::other(error)))?;
        self.finish()
    }

    /// Brings the file to the disk and gives it its name.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn finish(self) -> Result<(), WriteError> {
        let Self { destination, partial, .. } = self;
        let done = partial.as_file().sync_all();
        done.and_then(|()| partial.persist(&destination).map_err(|error| error.error))
            .map_err(WriteError::at(&destination))?;
        Ok(())
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.partial.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.partial.as_file_mut().flush()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

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
    fn folders_are_made_and_removed_again() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("new/deep/a.txt");
        drop(OutputFile::create_with_folders(&path).expect("writable"));
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 0, "nothing is left");
        OutputFile::create_with_folders(&path).expect("writable").finish().expect("renamed");
        assert!(path.is_file(), "there");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_other_file() {
        use std::os::unix::fs::PermissionsExt;

        let folder = tempfile::tempdir().expect("a temporary folder");
        let mode = |path: &Path| fs::metadata(path).expect("there").permissions().mode();
        let (plain, ours) = (folder.path().join("plain"), folder.path().join("ours"));
        fs::write(&plain, "").expect("writable");
        OutputFile::create(&ours).expect("writable").finish().expect("renamed");
        assert_eq!(mode(&ours), mode(&plain), "as the system gives them");
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
