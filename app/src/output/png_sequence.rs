// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A directory of numbered PNG files.

use std::fs;
use std::path::Path;

use image::RgbaImage;

use super::OutputError;
use super::beside::Beside;
use super::still::save_png;

/// Writes every frame as it comes.
#[derive(Debug)]
pub(super) struct PngSequence {
    beside: Beside,
    count: u32,
}

impl PngSequence {
    pub(super) fn start(path: &Path) -> Result<Self, OutputError> {
        if path.exists() && !path.is_dir() {
            let source = std::io::Error::from(std::io::ErrorKind::NotADirectory);
            return Err(OutputError::Write { path: path.to_owned(), source });
        }
        Ok(Self { beside: Beside::directory(path)?, count: 0 })
    }

    pub(super) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        self.count += 1;
        save_png(frame, &self.beside.partial().join(name(self.count)), self.beside.destination())
    }

    /// Moves the directory into place; into one that is already there, frame by frame. Frames of an earlier, longer
    /// clip in it are removed, other files stay.
    pub(super) fn finish(self) -> Result<(), OutputError> {
        let destination = self.beside.destination();
        if !destination.exists() {
            return self.beside.put_in_place();
        }
        for number in 1..=self.count {
            let from = self.beside.partial().join(name(number));
            fs::rename(from, destination.join(name(number))).map_err(OutputError::write(destination))?;
        }
        let stale = (self.count + 1..).map(|number| destination.join(name(number)));
        for path in stale.take_while(|path| path.exists()) {
            fs::remove_file(path).map_err(OutputError::write(destination))?;
        }
        Ok(())
    }
}

fn name(number: u32) -> String {
    format!("frame_{number:04}.png")
}
