// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads files that scenes name: regular ones of a bounded size alone, as a pipe that nobody writes to and a device have no end. And
//! distinguishes those that lie in a folder from those outside it.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Component, Path, absolute};

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

/// Returns true if `path` lies in `folder` or below, after links are followed. Of a path to nothing the letters decide.
pub(crate) fn lies_below(folder: &Path, path: &Path) -> bool {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match (folder.canonicalize(), path.canonicalize()) {
        (Ok(folder), Ok(path)) => path.starts_with(folder),
        _ => {
            let (Ok(folder), Ok(path)) = (absolute(folder), absolute(path)) else { return false };
            let is_plain = |part| matches!(part, Component::Normal(_) | Component::CurDir);
            path.strip_prefix(folder).is_ok_and(|rest| rest.components().all(is_plain))
        }
    }
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

    #[test]
    fn only_what_lies_below_is_below() {
        let there = tempfile::tempdir().expect("a temporary folder");
        let folder = there.path().join("scenes");
        fs::create_dir_all(folder.join("in")).expect("writable");
        fs::write(folder.join("in/a"), "").expect("writable");
        fs::write(there.path().join("b"), "").expect("writable");
        fs::create_dir(there.path().join("scenes too")).expect("writable");
        fs::write(there.path().join("scenes too/c"), "").expect("writable");
        let is_below = |name: &str| lies_below(&folder, &folder.join(name));
        for name in ["in/a", "in/../in/a", "./in/a", "in", "none", "none/deeper"] {
            assert!(is_below(name), "{name} lies below");
        }
        let absolute = folder.join("in/a");
        assert!(is_below(absolute.to_str().expect("plain")), "an absolute path to what lies below");
        for name in
            ["../b", "in/../../b", "../scenes too/c", "../none", "none/../../x", "/etc/passwd", "/none"]
        {
            assert!(!is_below(name), "{name} lies outside");
        }
        assert!(lies_below(Path::new(""), Path::new("Cargo.toml")), "the current folder has no name");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed() {
        use std::os::unix::fs::symlink;

        let there = tempfile::tempdir().expect("a temporary folder");
        let folder = there.path().join("scenes");
        fs::create_dir_all(folder.join("in")).expect("writable");
        fs::write(folder.join("in/a"), "").expect("writable");
        fs::write(there.path().join("b"), "").expect("writable");
        symlink("../b", folder.join("out")).expect("writable");
        symlink("..", folder.join("up")).expect("writable");
        symlink("in/a", folder.join("stays")).expect("writable");
        symlink("scenes", there.path().join("by another name")).expect("writable");
        let is_below = |name: &str| lies_below(&folder, &folder.join(name));
        assert!(!is_below("out") && !is_below("up/b"), "links that lead out");
        assert!(is_below("stays"), "a link that does not");
        let other = there.path().join("by another name");
        assert!(lies_below(&other, &other.join("in/a")), "the folder itself may be a link");
    }
}
