// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Work in progress that outlives a run: a hidden folder beside the destination, until the work is done.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

use super::output_folder::move_files;
use super::parents::{MadeFolders, parent};
use super::{Identity, OutputFile, WriteError};

/// Ending of the folder's name.
const ENDING: &str = ".unfinished";
/// Identity of the work.
const IDENTITY: &str = "work.json";
/// Locked by the run that is at work.
const LOCK: &str = "lock";
/// Progress of the work, where its parts do not say it.
const PROGRESS: &str = "progress.json";
/// Folder of what is finished of it.
const PARTS: &str = "parts";
/// There once finished parts are being moved to their destination.
const MOVING: &str = "moving";

/// Work in progress. What is put into [`UnfinishedWork::parts`] outlives this run: dropped before [`UnfinishedWork::finish`], the folder stays
/// if there is anything in it, or, [`by_progress`](UnfinishedWork::by_progress), if any progress was noted.
#[derive(Debug)]
pub(crate) struct UnfinishedWork {
    destination: PathBuf,
    folder: PathBuf,
    is_finished: bool,
    /// Parts count only as far as the noted progress says so.
    needs_progress: bool,
    _lock: File,
    /// Go after it.
    _made: MadeFolders,
}

/// Work that cannot be begun or gone on with.
#[derive(Debug, Error)]
pub(crate) enum WorkError {
    /// A path that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Another program is at work there.
    #[error("{}: another run is writing it; allowed: to wait for it, or another --out", path.display())]
    Busy {
        /// The destination.
        path: PathBuf,
    },
    /// Unfinished work of something else.
    #[error(
        "{}: beside it lies unfinished work of another run ({difference}); allowed: the options of that run, which goes on with it, \
         or --restart, which throws it away",
        path.display()
    )]
    Other {
        /// The destination.
        path: PathBuf,
        /// Names of the values that differ.
        difference: String,
    },
}

impl UnfinishedWork {
    /// Begins the work for `destination`, or goes on with it if the same work was begun there; with `restart` whatever was begun is thrown
    /// away. Folders above it are made.
    ///
    /// # Errors
    /// Work of another identity, a run that is at work, a path that cannot be written.
    pub(crate) fn open(destination: &Path, identity: &Identity, restart: bool) -> Result<Self, WorkError> {
        Self::open_part(destination, "", identity, restart)
    }

    /// The same for a part of the result; those of other names are made apart.
    ///
    /// # Errors
    /// Those of [`UnfinishedWork::open`].
    pub(crate) fn open_part(
        destination: &Path,
        part: &str,
        identity: &Identity,
        restart: bool,
    ) -> Result<Self, WorkError> {
        let fail = |reason: &str| WriteError::at(destination)(io::Error::other(reason));
        let name = destination.file_name().ok_or_else(|| fail("it names no file or folder"))?;
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(part);
        hidden.push(ENDING);
        let folder = parent(destination).join(hidden);
        let made = MadeFolders::make(parent(destination)).map_err(WriteError::at(destination))?;
        let lock = lock(destination, &folder)?;
        let work = Self {
            destination: destination.to_owned(),
            folder,
            is_finished: false,
            needs_progress: false,
            _lock: lock,
            _made: made,
        };
        let (path, text) = (work.folder.join(IDENTITY), identity.text());
        let known = fs::read_to_string(&path).ok();
        match known {
            Some(found) if found == text && !restart => return Ok(work),
            Some(found) if !restart && (work.is_begun() || work.has_progress()) => {
                let difference = identity.difference(&found);
                return Err(WorkError::Other { path: destination.to_owned(), difference });
            }
            _ => {}
        }
        // Of parts without their identity nothing is known.
        for name in [PARTS, MOVING, PROGRESS] {
            remove(&work.folder.join(name)).map_err(WriteError::at(destination))?;
        }
        fs::create_dir_all(work.parts()).map_err(WriteError::at(destination))?;
        OutputFile::write_whole(&path, text.as_bytes())?;
        Ok(work)
    }

    /// Parts that no progress was noted of are worth nothing.
    pub(crate) fn by_progress(self) -> Self {
        let mut work = self;
        work.needs_progress = true;
        work
    }

    fn has_progress(&self) -> bool {
        self.folder.join(PROGRESS).exists()
    }

    /// Path that the result will lie at.
    pub(crate) fn destination(&self) -> &Path {
        &self.destination
    }

    /// Folder of what is finished.
    pub(crate) fn parts(&self) -> PathBuf {
        self.folder.join(PARTS)
    }

    /// A finished part, if it is there: in its folder, or already where it belongs.
    pub(crate) fn part(&self, name: &str) -> Option<PathBuf> {
        let is_moving = self.folder.join(MOVING).exists();
        let at_destination = || is_moving.then(|| self.destination.join(name));
        [Some(self.parts().join(name)), at_destination()].into_iter().flatten().find(|path| path.is_file())
    }

    /// Returns true if some of it is finished.
    pub(crate) fn is_begun(&self) -> bool {
        self.folder.join(MOVING).exists()
            || fs::read_dir(self.parts()).is_ok_and(|mut entries| entries.next().is_some())
    }

    /// Progress that an earlier run has noted.
    pub(crate) fn progress<T: DeserializeOwned>(&self) -> Option<T> {
        serde_json::from_str(&fs::read_to_string(self.folder.join(PROGRESS)).ok()?).ok()
    }

    /// Notes how far it is, once what that says is written.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn note_progress(&self, progress: &impl Serialize) -> Result<(), WriteError> {
        let text =
            serde_json::to_vec(progress).map_err(|error| WriteError::at(&self.destination)(error.into()))?;
        OutputFile::write_whole(&self.folder.join(PROGRESS), &text)
    }

    /// Returns true if all parts have been moved to their destination.
    pub(crate) fn is_moved(&self) -> bool {
        self.folder.join(MOVING).exists() && !self.parts().exists()
    }

    /// Moves the folder of all parts to its destination, where nothing lies.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn move_parts(&self, to: &Path) -> Result<(), WriteError> {
        fs::write(self.folder.join(MOVING), "").map_err(WriteError::at(to))?;
        fs::rename(self.parts(), to).map_err(WriteError::at(to))
    }

    /// Ends the work: its result lies at the destination.
    pub(crate) fn finish(mut self) {
        self.is_finished = true;
    }

    /// Moves all parts into a folder at the destination, that named `last` after all others, and ends the work. Other files there stay.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn finish_in_folder(self, last: &str) -> Result<(), WriteError> {
        // Another part may have made it a moment ago.
        if !self.destination.exists() && self.move_parts(&self.destination).is_ok() {
            self.finish();
            return Ok(());
        }
        if self.parts().exists() {
            fs::create_dir_all(&self.destination).map_err(WriteError::at(&self.destination))?;
            fs::write(self.folder.join(MOVING), "").map_err(WriteError::at(&self.destination))?;
            move_files(&self.parts(), &self.destination, last)?;
        }
        self.finish();
        Ok(())
    }
}

impl Drop for UnfinishedWork {
    fn drop(&mut self) {
        let is_worth_it = if self.needs_progress { self.has_progress() } else { self.is_begun() };
        if self.is_finished || !is_worth_it {
            // The identity last: until then the work is known. What cannot be removed does no harm.
            let _ = fs::remove_dir_all(self.parts());
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

/// Makes the folder and takes its lock.
fn lock(destination: &Path, folder: &Path) -> Result<File, WorkError> {
    let path = folder.join(LOCK);
    loop {
        fs::create_dir_all(folder).map_err(WriteError::at(destination))?;
        let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path);
        let file = match file {
            Ok(file) => file,
            // Another run has just removed the folder.
            Err(error) if error.kind() == io::ErrorKind::NotFound && !folder.exists() => continue,
            Err(error) => return Err(WriteError::at(destination)(error).into()),
        };
        match file.try_lock() {
            // That run may also have removed it between opening and locking.
            Ok(()) if path.exists() => return Ok(file),
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(WorkError::Busy { path: destination.to_owned() }),
            // Where the disk has no locks, two runs at once are the user's care.
            Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
}

/// Removes a file or folder if it is there.
fn remove(path: &Path) -> io::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(kind) if kind.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn identity(fps: u32) -> Identity {
        Identity::new(json!({ "fps": fps }))
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("there").file_name().into_string().expect("plain")).collect();
        names.sort();
        names
    }

    #[test]
    fn finished_parts_outlive_a_run_and_are_gone_when_all_is_done() {
        let there = tempfile::tempdir().expect("a temporary folder");
        let path = there.path().join("clip");
        let open = |fps, restart| UnfinishedWork::open(&path, &identity(fps), restart);
        drop(open(30, false).expect("writable"));
        drop(
            UnfinishedWork::open(&there.path().join("new/deep/clip"), &identity(1), false).expect("writable"),
        );
        assert!(names(there.path()).is_empty(), "nothing was done");
        let work = open(30, false).expect("writable");
        fs::write(work.parts().join("a"), "done").expect("writable");
        let error = open(30, false).expect_err("at work").to_string();
        assert!(error.contains("another run is writing it"), "{error}");
        drop(work);
        let error = open(60, false).expect_err("another").to_string();
        assert!(error.contains("other fps") && error.contains("--restart"), "{error}");
        let work = open(30, false).expect("the same");
        assert!(work.part("a").is_some() && work.part("b").is_none(), "what is done");
        fs::write(work.parts().join("b"), "done").expect("writable");
        work.finish_in_folder("").expect("writable");
        assert_eq!(
            (names(there.path()), names(&path)),
            (vec!["clip".into()], vec!["a".into(), "b".into()]),
            "all of it"
        );
        let work = open(60, false).expect("nothing is left of the first");
        fs::write(work.parts().join("c"), "done").expect("writable");
        drop(work);
        assert!(open(90, true).expect("thrown away").part("c").is_none(), "restarted");
        assert_eq!(names(there.path()), ["clip"], "nothing of it is left");
    }

    #[test]
    fn a_run_that_ended_while_it_moved_its_parts_knows_them() {
        let there = tempfile::tempdir().expect("a temporary folder");
        let path = there.path().join("clip");
        fs::create_dir(&path).expect("writable");
        let work = UnfinishedWork::open(&path, &identity(1), false).expect("writable");
        fs::write(path.join("z"), "of an older clip").expect("writable");
        ["a", "b"].iter().for_each(|name| fs::write(work.parts().join(name), name).expect("writable"));
        // As finish_in_folder begins.
        fs::write(work.folder.join(MOVING), "").expect("writable");
        fs::rename(work.parts().join("a"), path.join("a")).expect("writable");
        drop(work);
        let work = UnfinishedWork::open(&path, &identity(1), false).expect("the same");
        assert!(work.part("a").is_some() && work.part("b").is_some(), "moved and not");
        work.finish_in_folder("").expect("writable");
        assert_eq!(names(&path), ["a", "b", "z"], "all");
        assert_eq!(names(there.path()), ["clip"], "nothing else");
    }
}
