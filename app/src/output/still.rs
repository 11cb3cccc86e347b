// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One PNG: the last frame.

use std::path::Path;

use image::{ImageFormat, RgbaImage};

use super::OutputError;
use super::beside::Beside;

/// Keeps the last frame and writes it at the end.
#[derive(Debug)]
pub(super) struct Still {
    beside: Beside,
    last: Option<RgbaImage>,
}

impl Still {
    pub(super) fn start(path: &Path) -> Result<Self, OutputError> {
        Ok(Self { beside: Beside::file(path, "png")?, last: None })
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
            save_png(frame, self.beside.partial(), self.beside.destination())?;
        }
        self.beside.put_in_place()
    }
}

/// Writes `frame` to `file`; errors speak of `destination`.
pub(super) fn save_png(frame: &RgbaImage, file: &Path, destination: &Path) -> Result<(), OutputError> {
    frame.save_with_format(file, ImageFormat::Png).map_err(|error| match error {
        image::ImageError::IoError(source) => OutputError::Write { path: destination.to_owned(), source },
        other => OutputError::Encode { path: destination.to_owned(), reason: other.to_string() },
    })
}
