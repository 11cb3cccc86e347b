// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One PNG: the last frame.

use std::path::Path;

use image::{ImageFormat, RgbaImage};

use super::OutputError;
use crate::files::{OutputFile, WriteError};

/// Keeps the last frame and writes it at the end.
#[derive(Debug)]
pub(super) struct Still {
    file: OutputFile,
    last: Option<RgbaImage>,
}

impl Still {
    pub(super) fn start(path: &Path) -> Result<Self, OutputError> {
        Ok(Self { file: OutputFile::create_with_folders(path)?, last: None })
    }

    pub(super) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        match &mut self.last {
            Some(last) => last.clone_from(frame),
            None => self.last = Some(frame.clone()),
        }
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), OutputError> {
        if let Some(frame) = &self.last {
            save_png(frame, self.file.partial(), self.file.destination())?;
        }
        Ok(self.file.finish()?)
    }
}

/// Writes `frame` to `file`; errors speak of `destination`.
pub(super) fn save_png(frame: &RgbaImage, file: &Path, destination: &Path) -> Result<(), OutputError> {
    frame.save_with_format(file, ImageFormat::Png).map_err(|error| match error {
        image::ImageError::IoError(reason) => WriteError::at(destination)(reason).into(),
        other => OutputError::Encode { path: destination.to_owned(), reason: other.to_string() },
    })
}
