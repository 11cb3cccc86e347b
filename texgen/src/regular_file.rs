// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Opens files that folders and users name: regular ones alone, as a pipe that nobody writes to and a device have no end.
//! (The core crate has the like; this one depends on none of the others.)

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Opens a regular file, or one that a link leads to.
///
/// # Errors
/// Errors of the system; [`ErrorKind::InvalidInput`] for a folder, pipe or device.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    // Before it is opened, which would wait for a pipe's other end.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "a directory, a pipe or a device, not a file"));
    }
    File::open(path)
}

/// Opens a regular file of a folder, not one elsewhere that a link in the folder leads to.
///
/// # Errors
/// Those of [`open`]; [`ErrorKind::InvalidInput`] for such a link.
pub(crate) fn open_in(folder: &Path, name: &str) -> io::Result<File> {
    let path = folder.join(name);
    // Where there is nothing, opening says so.
    if let (Ok(folder), Ok(there)) = (folder.canonicalize(), path.canonicalize())
        && !there.starts_with(folder)
    {
        return Err(io::Error::new(ErrorKind::InvalidInput, "a link that leads out of its folder"));
    }
    open(&path)
}

/// The bytes of a regular file of a folder, of at most `most` bytes.
///
/// # Errors
/// Those of [`open_in`]; [`ErrorKind::FileTooLarge`].
pub(crate) fn read_in(folder: &Path, name: &str, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_in(folder, name)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::new(ErrorKind::FileTooLarge, format!("more than {most} bytes")));
    }
    Ok(bytes)
}
