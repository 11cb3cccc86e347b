// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writers of pictures and clips, fed frame by frame.
//!
//! Every writer works beside its destination and renames at the end, so an interrupted or failed run leaves no
//! half-written file behind. What is long in the making keeps its frames there ([`KeptClip`]).

mod error;
mod gif_clip;
mod kept_clip;
mod palette;
mod png_sequence;
mod still;
mod video;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use image::RgbaImage;

pub(crate) use error::OutputError;
use gif_clip::GifClip;
pub(crate) use kept_clip::KeptClip;
use png_sequence::PngSequence;
use still::Still;
use video::Video;

/// Kind and path of an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// The last frame as a PNG file.
    Png(PathBuf),
    /// A directory with `frame_0001.png`, `frame_0002.png`, …
    Sequence(PathBuf),
    /// A looping GIF file, at most 30 frames per second.
    Gif(PathBuf),
    /// An MP4 file, written by ffmpeg.
    Mp4(PathBuf),
}

impl Output {
    /// Chooses by extension: `.png`, `.gif`, `.mp4`, or none for a directory.
    ///
    /// # Errors
    /// [`OutputError::UnknownFormat`] for any other extension.
    pub(crate) fn from_path(path: &Path) -> Result<Self, OutputError> {
        let owned = path.to_owned();
        let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            _ if path.file_name().is_some() && path.is_dir() => Ok(Self::Sequence(owned)),
            Some("png") => Ok(Self::Png(owned)),
            Some("gif") => Ok(Self::Gif(owned)),
            Some("mp4") => Ok(Self::Mp4(owned)),
            None if path.file_name().is_some() && path.extension().is_none() => Ok(Self::Sequence(owned)),
            _ => Err(OutputError::UnknownFormat { path: owned }),
        }
    }

    /// Starts writing a clip of `fps` frames per second and `size` pixels. Whatever can be found wrong before the
    /// first frame is drawn is found here.
    ///
    /// # Errors
    /// A path that cannot be written, a size or rate the format cannot hold, or ffmpeg not being installed.
    pub(crate) fn start(&self, size: (u32, u32), fps: f64) -> Result<Writer, OutputError> {
        let kind = match self {
            Self::Png(path) => Kind::Png(Still::start(path)?),
            Self::Sequence(path) => Kind::Sequence(PngSequence::start(path)?),
            Self::Gif(path) => Kind::Gif(GifClip::start(path, size, fps)?),
            Self::Mp4(path) => Kind::Mp4(Video::start(path, size, fps)?),
        };
        Ok(Writer { path: self.path().to_owned(), kind, size, frames: 0 })
    }

    /// Every how many frames one is seen: a GIF file thins them out.
    pub(crate) fn stride(&self, fps: f64) -> u32 {
        if let Self::Gif(_) = self { gif_clip::frame_step(fps) } else { 1 }
    }

    /// Path that the result will lie at.
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Png(path) | Self::Sequence(path) | Self::Gif(path) | Self::Mp4(path) => path,
        }
    }
}

/// Takes the frames of one clip. Dropped without [`Writer::finish`], it removes what it wrote.
#[derive(Debug)]
pub(crate) struct Writer {
    path: PathBuf,
    kind: Kind,
    size: (u32, u32),
    frames: u32,
}

#[derive(Debug)]
enum Kind {
    Png(Still),
    Sequence(PngSequence),
    Gif(GifClip),
    Mp4(Video),
}

impl Writer {
    /// Takes the next frame.
    ///
    /// # Errors
    /// A full disk, a frame of another size, or a failed ffmpeg.
    pub(crate) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        if frame.dimensions() != self.size {
            let (path, expected, found) = (self.path.clone(), self.size, frame.dimensions());
            return Err(OutputError::FrameSize { path, expected, found });
        }
        self.frames += 1;
        match &mut self.kind {
            Kind::Png(still) => still.push(frame),
            Kind::Sequence(sequence) => sequence.push(frame),
            Kind::Gif(clip) => clip.push(frame),
            Kind::Mp4(video) => video.push(frame),
        }
    }

    /// Passes over a frame that is not wanted.
    pub(crate) fn skip(&mut self) {
        if let Kind::Gif(clip) = &mut self.kind {
            clip.skip();
        }
    }

    /// Completes the output under its own name and returns that.
    ///
    /// # Errors
    /// [`OutputError::NoFrames`] without any frame, or what the system says.
    pub(crate) fn finish(self) -> Result<PathBuf, OutputError> {
        if self.frames == 0 {
            return Err(OutputError::NoFrames { path: self.path });
        }
        match self.kind {
            Kind::Png(still) => still.finish()?,
            Kind::Sequence(sequence) => sequence.finish()?,
            Kind::Gif(clip) => clip.finish()?,
            Kind::Mp4(video) => video.finish()?,
        }
        Ok(self.path)
    }
}

#[cfg(test)]
mod tests;
