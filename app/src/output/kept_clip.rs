// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A clip whose frames are kept beside it until it is complete: a run that ends early loses none of them.

use std::path::PathBuf;

use image::{ImageFormat, ImageReader, RgbaImage};

use super::png_sequence::{file_name, remove_stale};
use super::{Output, OutputError, Writer};
use crate::files::{Identity, OutputFile, UnfinishedWork, WriteError};
use crate::run::frame_range::FrameRange;

/// Takes the frames of a clip in their order, each once: new ones, and those that an earlier run has kept.
#[derive(Debug)]
pub(crate) enum KeptClip {
    /// A picture, finished with its only frame.
    Still(Writer),
    /// A file that is written from frames, those that were kept first.
    File { frames: UnfinishedWork, writer: Box<Writer> },
    /// A folder that the frames are moved to.
    Folder(UnfinishedWork),
}

impl KeptClip {
    /// Begins a clip or a part of one, or goes on with one of the same identity; with `restart` from its first frame.
    ///
    /// # Errors
    /// Errors of [`Output::start`]; unfinished frames of another clip; another run that is at work on it.
    pub(crate) fn begin(
        output: &Output,
        size: (u32, u32),
        fps: f64,
        part: Option<FrameRange>,
        (identity, restart): (&Identity, bool),
    ) -> anyhow::Result<Self> {
        let writer = output.start(size, fps)?;
        let part = part.map_or(String::new(), |FrameRange { first, last }| format!(".{first}..{last}"));
        let open = || UnfinishedWork::open_part(output.path(), &part, identity, restart);
        Ok(match output {
            Output::Png(_) => Self::Still(writer),
            Output::Sequence(_) => {
                // It was begun to find what is wrong with the place.
                drop(writer);
                Self::Folder(open()?)
            }
            Output::Gif(_) | Output::Mp4(_) => Self::File { frames: open()?, writer: Box::new(writer) },
        })
    }

    /// Returns true if a frame was kept.
    pub(crate) fn has(&self, number: u32) -> bool {
        self.frames().is_some_and(|frames| frames.part(&file_name(number)).is_some())
    }

    fn frames(&self) -> Option<&UnfinishedWork> {
        match self {
            Self::Still(_) => None,
            Self::File { frames, .. } | Self::Folder(frames) => Some(frames),
        }
    }

    /// Takes a new frame.
    ///
    /// # Errors
    /// A full disk, a frame of another size, a failed ffmpeg.
    pub(crate) fn push(&mut self, number: u32, frame: &RgbaImage) -> Result<(), OutputError> {
        if let Some(frames) = self.frames() {
            OutputFile::create(&frames.parts().join(file_name(number)))?.finish_png(frame)?;
        }
        match self {
            Self::Still(writer) => writer.push(frame),
            Self::File { writer, .. } => writer.push(frame),
            Self::Folder(_) => Ok(()),
        }
    }

    /// Takes a frame that an earlier run has kept.
    ///
    /// # Errors
    /// A file that is no picture any more; what [`KeptClip::push`] finds.
    pub(crate) fn push_kept(&mut self, number: u32) -> Result<(), OutputError> {
        let Self::File { frames, writer } = self else { return Ok(()) };
        let path = frames.parts().join(file_name(number));
        let mut reader = ImageReader::open(&path).map_err(WriteError::at(&path))?;
        reader.set_format(ImageFormat::Png);
        let picture =
            reader.decode().map_err(|error| OutputError::Encode { path, reason: error.to_string() })?;
        writer.push(&picture.into_rgba8())
    }

    /// Passes over a frame that the format leaves out.
    pub(crate) fn skip(&mut self) {
        if let Self::File { writer, .. } = self {
            writer.skip();
        }
    }

    /// Completes the clip and returns its path. In a folder that is there, frames behind the first `whole` are removed: those of an earlier,
    /// longer clip.
    ///
    /// # Errors
    /// Errors of the system; [`OutputError::NoFrames`].
    pub(crate) fn finish(self, whole: Option<u32>) -> Result<PathBuf, OutputError> {
        match self {
            Self::Still(writer) => writer.finish(),
            Self::File { frames, writer } => {
                let path = writer.finish()?;
                frames.finish();
                Ok(path)
            }
            Self::Folder(frames) => {
                let path = frames.destination().to_owned();
                frames.finish_in_folder("")?;
                whole.map_or(Ok(()), |count| remove_stale(&path, count))?;
                Ok(path)
            }
        }
    }
}
