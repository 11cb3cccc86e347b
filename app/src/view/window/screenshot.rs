// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A picture of the window, panel and all, after some time.

use std::path::Path;
use std::time::{Duration, Instant};

use image::RgbaImage;

use crate::files::OutputFile;

/// Frames that are drawn first, so that nothing is caught while it is being laid out.
const MIN_FRAMES: u32 = 4;

/// A picture to be taken.
#[derive(Debug)]
pub(crate) struct Screenshot {
    file: OutputFile,
    after: Duration,
    began: Instant,
    frames: u32,
}

impl Screenshot {
    /// Makes sure that the file can be written.
    ///
    /// # Errors
    /// Whatever would keep it from being written.
    pub(crate) fn prepare(path: &Path, after_s: f64) -> anyhow::Result<Self> {
        Ok(Self {
            file: OutputFile::create(path)?,
            after: Duration::from_secs_f64(after_s),
            began: Instant::now(),
            frames: 0,
        })
    }

    /// The window is there: time begins now.
    pub(crate) fn begin(&mut self) {
        self.began = Instant::now();
    }

    /// Counts a frame; true when the picture is due.
    pub(crate) fn is_due(&mut self) -> bool {
        self.frames += 1;
        self.frames > MIN_FRAMES && self.began.elapsed() >= self.after
    }

    /// Writes the picture.
    ///
    /// # Errors
    /// Errors of the system, for example a full disk.
    pub(crate) fn save(self, picture: &RgbaImage) -> anyhow::Result<()> {
        Ok(self.file.finish_png(picture)?)
    }
}
