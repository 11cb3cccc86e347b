// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads files that scenes name: regular ones of a bounded size alone, as a pipe that nobody writes to and a device have no end.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The bytes of a regular file of at most `most` bytes, or of one that a link leads to.
///
/// # Errors
/// Errors of the system; [`ErrorKind::InvalidInput`] for a folder, pipe or device; [`ErrorKind::FileTooLarge`].
pub fn read_regular_file(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Before it is opened, which would wait for a pipe's other end.
    let kind = fs::metadata(path)?;
    if !kind.is_file() {
        let found = if kind.is_dir() { "a directory, not a file" } else { "a pipe or a device, not a file" };
        return Err(io::Error::new(ErrorKind::InvalidInput, found));
    }
    let mut bytes = Vec::new();
    // Its length may be other than it says.
    File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::new(ErrorKind::FileTooLarge, format!("more than {most} bytes")));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_files_of_a_bounded_size_are_read() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a");
        fs::write(&path, "five!").expect("writable");
        assert_eq!(read_regular_file(&path, 5).expect("read"), b"five!", "all of it");
        assert_eq!(
            read_regular_file(&path, 4).expect_err("too long").kind(),
            ErrorKind::FileTooLarge,
            "bounded"
        );
        assert_eq!(
            read_regular_file(folder.path(), 4).expect_err("a folder").kind(),
            ErrorKind::InvalidInput,
            "a folder"
        );
        let none = read_regular_file(&folder.path().join("b"), 4).expect_err("nothing");
        assert_eq!(none.kind(), ErrorKind::NotFound, "nothing");
    }

    #[cfg(unix)]
    #[test]
    fn devices_and_links_to_them_are_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let link = folder.path().join("endless");
        std::os::unix::fs::symlink("/dev/zero", &link).expect("writable");
        for path in [Path::new("/dev/zero"), &link] {
            assert_eq!(
                read_regular_file(path, 9).expect_err("endless").kind(),
                ErrorKind::InvalidInput,
                "{path:?}"
            );
        }
    }
}
