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

/// The bytes of a regular file of at most `most` bytes.
///
/// # Errors
/// Those of [`open`]; [`ErrorKind::FileTooLarge`].
pub(crate) fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::new(ErrorKind::FileTooLarge, format!("more than {most} bytes")));
    }
    Ok(bytes)
}
