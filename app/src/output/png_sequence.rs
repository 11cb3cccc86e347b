// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A directory of numbered PNG files.

use std::fs;
use std::path::Path;

use image::RgbaImage;

use super::OutputError;
use super::still::save_png;
use crate::files::{OutputFolder, WriteError};

/// Writes every frame as it comes.
#[derive(Debug)]
pub(super) struct PngSequence {
    folder: OutputFolder,
    count: u32,
}

impl PngSequence {
    pub(super) fn start(path: &Path) -> Result<Self, OutputError> {
        Ok(Self { folder: OutputFolder::create(path)?, count: 0 })
    }

    pub(super) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        let path = self.folder.partial().join(file_name(self.count));
        self.count += 1;
        save_png(frame, &path, self.folder.destination())
    }

    /// Moves the directory into place; into one that is already there, frame by frame. Frames of an earlier, longer
    /// clip in it are removed, other files stay.
    pub(super) fn finish(self) -> Result<(), OutputError> {
        let destination = self.folder.destination().to_owned();
        self.folder.finish("")?;
        remove_stale(&destination, self.count)
    }
}

/// Removes the frames behind the first `count` that an earlier, longer clip has left in a folder.
pub(super) fn remove_stale(folder: &Path, count: u32) -> Result<(), OutputError> {
    let stale = (count..).map(|number| folder.join(file_name(number)));
    for path in stale.take_while(|path| path.exists()) {
        fs::remove_file(path).map_err(WriteError::at(folder))?;
    }
    Ok(())
}

/// Name of the file of a frame, counted from 0.
pub(super) fn file_name(number: u32) -> String {
    format!("frame_{:04}.png", u64::from(number) + 1)
}
