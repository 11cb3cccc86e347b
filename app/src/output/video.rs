// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! MP4 through ffmpeg, fed with raw frames.

use std::ffi::OsStr;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;

use image::RgbaImage;

use super::OutputError;
use super::gif_clip::check_rate;
use crate::files::OutputFile;

/// A clip that ffmpeg writes.
#[derive(Debug)]
pub(super) struct Video {
    /// Ends before the file is removed.
    ffmpeg: Ffmpeg,
    file: OutputFile,
}

/// A running ffmpeg.
#[derive(Debug)]
struct Ffmpeg {
    child: Child,
    /// Collects what ffmpeg says, so that it never blocks on a full pipe.
    messages: Option<JoinHandle<String>>,
}

impl Video {
    pub(super) fn start(path: &Path, size: (u32, u32), fps: f64) -> Result<Self, OutputError> {
        Self::start_with(OsStr::new("ffmpeg"), path, size, fps)
    }

    /// The same with another program in ffmpeg's place.
    pub(super) fn start_with(
        program: &OsStr,
        path: &Path,
        (width, height): (u32, u32),
        fps: f64,
    ) -> Result<Self, OutputError> {
        check_rate(path, fps)?;
        if width == 0 || height == 0 || width % 2 != 0 || height % 2 != 0 {
            let allowed = "mp4 allows even numbers only";
            return Err(OutputError::Size { path: path.to_owned(), width, height, allowed });
        }
        let file = OutputFile::create_with_folders(path)?;
        let mut command = Command::new(program);
        // An interrupt from the terminal is for this program, which ends ffmpeg itself.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command
            .args(["-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"])
            .args(["-s", &format!("{width}x{height}"), "-r", &fps.to_string(), "-i", "-"])
            // Colours as the sRGB picture has them, in a form that every player reads.
            .args(["-vf", "scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709"])
            .args(["-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-pix_fmt", "yuv420p"])
            .args(["-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"])
            .arg(file.partial())
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| match error.kind() {
                ErrorKind::NotFound => OutputError::NoFfmpeg { path: path.to_owned() },
                _ => OutputError::Ffmpeg { path: path.to_owned(), reason: error.to_string() },
            })?;
        let messages = child.stderr.take().map(|mut stderr| {
            std::thread::spawn(move || {
                let mut text = Vec::new();
                // What cannot be read is not worth failing for: the exit status decides.
                let _ = stderr.read_to_end(&mut text);
                String::from_utf8_lossy(&text).trim().replace('\n', "; ")
            })
        });
        Ok(Self { ffmpeg: Ffmpeg { child, messages }, file })
    }

    pub(super) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        let written = self.ffmpeg.child.stdin.as_mut().map(|stdin| stdin.write_all(frame.as_raw()));
        match written {
            Some(Ok(())) => Ok(()),
            _ => Err(self.failure()),
        }
    }

    pub(super) fn finish(mut self) -> Result<(), OutputError> {
        drop(self.ffmpeg.child.stdin.take());
        match self.ffmpeg.child.wait() {
            Ok(status) if status.success() => Ok(self.file.finish()?),
            _ => Err(self.failure()),
        }
    }

    fn failure(&mut self) -> OutputError {
        OutputError::Ffmpeg { path: self.file.destination().to_owned(), reason: self.ffmpeg.end() }
    }
}

impl Ffmpeg {
    /// Ends ffmpeg and returns its last messages.
    fn end(&mut self) -> String {
        drop(self.child.stdin.take());
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let said = self.messages.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        if said.is_empty() { status } else { said }
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        // An abandoned clip: the partial file is removed right after, so ffmpeg must not write to it any more.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
