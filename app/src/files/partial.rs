// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files and folders in the making that nobody works on any more.
//!
//! Whoever makes one holds a lock on it, which the system lets go when the program ends, however it ends. So one that can be locked
//! belongs to a run that is dead. Elsewhere than on Unix a lock would keep other programs (an encoder) from the file: there such files
//! stay.

#[cfg(unix)]
pub(super) use unix::{hold, remove_dead};

#[cfg(unix)]
mod unix {
    use std::ffi::OsStr;
    use std::fs::{self, File};
    use std::path::Path;

    /// Holds the lock of a file or folder in the making. False if a run that took it for dead has removed it.
    pub(in super::super) fn hold(lock: &File, path: &Path) -> bool {
        // A run that takes it for dead holds it until it is removed. Where the disk has no locks, nothing is ever taken for dead.
        let _ = lock.lock();
        path.exists()
    }

    /// Removes what dead runs have left in `folder` under names that begin with `prefix` and end as something in the making does.
    pub(in super::super) fn remove_dead(folder: &Path, prefix: &OsStr) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        for entry in entries.flatten() {
            let (name, path) = (entry.file_name(), entry.path());
            let rest = name.as_encoded_bytes().strip_prefix(prefix.as_encoded_bytes());
            let is_partial = rest.is_some_and(|rest| {
                let ending =
                    rest.windows(super::ENDING.len()).position(|part| part == super::ENDING.as_bytes());
                // Between them stand the random letters that make it unlike any other.
                ending == Some(super::LETTERS) && rest[..super::LETTERS].iter().all(u8::is_ascii_alphanumeric)
            });
            // A file or folder, not what a link leads to.
            let Ok(kind) = entry.file_type() else { continue };
            if !is_partial || kind.is_symlink() {
                continue;
            }
            let is_dead = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
            if is_dead {
                // What cannot be removed does no harm.
                let _ = if kind.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            }
        }
    }
}

/// Ending of everything in the making.
pub(super) const ENDING: &str = ".partial";
/// Number of random letters in its name.
pub(super) const LETTERS: usize = 6;

#[cfg(not(unix))]
pub(super) fn hold(_: &std::fs::File, _: &std::path::Path) -> bool {
    true
}

#[cfg(not(unix))]
pub(super) fn remove_dead(_: &std::path::Path, _: &std::ffi::OsStr) {}

#[cfg(all(test, unix))]
mod tests {
    use std::fs;

    use crate::files::{OutputFile, OutputFolder};

    #[test]
    fn what_dead_runs_left_is_removed_and_what_others_work_on_stays() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        let names = || {
            let entries = fs::read_dir(&folder).expect("a folder");
            let mut names: Vec<_> = entries
                .map(|entry| entry.expect("there").file_name().into_string().expect("plain"))
                .collect();
            names.sort();
            names
        };
        // As a killed run leaves them: nobody holds them.
        fs::write(path(".a.txt.Xy3kAb.partial.txt"), "half").expect("writable");
        fs::create_dir(path(".out.Zz9qqq.partial")).expect("writable");
        fs::write(path(".out.Zz9qqq.partial/frame"), "half").expect("writable");
        // Of others, or of nobody.
        let others = [
            ".a.txt.ab.partial.txt",
            ".a.txt.b.c.partial.txt",
            ".a.txt.mine",
            ".b.txt.Xy3kAb.partial.txt",
            "a.txt.Xy3kAb.partial.txt",
        ];
        others.iter().for_each(|name| fs::write(path(name), "kept").expect("writable"));
        let at_work = OutputFile::create(&path("a.txt")).expect("writable");
        let partial = at_work.partial().file_name().expect("a name").to_str().expect("plain").to_owned();
        let second = OutputFile::create(&path("a.txt")).expect("writable");
        assert!(names().contains(&partial), "another is at work on it: {:?}", names());
        drop((at_work, second));
        drop(OutputFolder::create(&path("out")).expect("writable"));
        let mut wanted = others.map(String::from);
        wanted.sort();
        assert_eq!(names(), wanted, "what is left");
    }
}
