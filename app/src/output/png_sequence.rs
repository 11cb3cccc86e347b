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
        self.count += 1;
        save_png(frame, &self.folder.partial().join(name(self.count)), self.folder.destination())
    }

    /// Moves the directory into place; into one that is already there, frame by frame. Frames of an earlier, longer
    /// clip in it are removed, other files stay.
    pub(super) fn finish(self) -> Result<(), OutputError> {
        let destination = self.folder.destination().to_owned();
        self.folder.finish("")?;
        let stale = (self.count + 1..).map(|number| destination.join(name(number)));
        for path in stale.take_while(|path| path.exists()) {
            fs::remove_file(path).map_err(WriteError::at(&destination))?;
        }
        Ok(())
    }
}

fn name(number: u32) -> String {
    format!("frame_{number:04}.png")
}
