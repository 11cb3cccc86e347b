// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! GIF: one palette for the whole clip, dithered; of each frame only what changed.
//!
//! The palette needs all frames, so they wait in a nameless file on the same disk until the clip ends.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

use gif::{Encoder, EncodingError, Frame, Repeat};
use image::RgbaImage;

use super::OutputError;
use super::palette::{Histogram, Palette};
use crate::files::{OutputFile, WriteError};

/// More frames per second than this are thinned out: viewers slow faster clips down, and size grows with frames.
const MAX_FPS: f64 = 34.0;
/// A pixel that differs less than this from what is shown stays as it is.
const UNSEEN: u8 = 7;
/// Palette number of pixels that stay as they are.
const UNCHANGED: u8 = 255;
/// GIF counts time in hundredths of a second.
const TICKS_PER_S: f64 = 100.0;

/// Frames waiting for their palette.
#[derive(Debug)]
pub(super) struct GifClip {
    file: OutputFile,
    waiting: BufWriter<File>,
    size: (u32, u32),
    /// Every how many frames one is kept.
    step: u32,
    /// Hundredths of a second from one kept frame to the next.
    ticks: f64,
    pushed: u32,
    kept: u32,
    histogram: Histogram,
}

impl GifClip {
    pub(super) fn start(path: &Path, size: (u32, u32), fps: f64) -> Result<Self, OutputError> {
        check_rate(path, fps)?;
        let (width, height) = size;
        let limit = u32::from(u16::MAX);
        if width == 0 || height == 0 || width > limit || height > limit {
            let allowed = "gif allows 1x1 to 65535x65535";
            return Err(OutputError::Size { path: path.to_owned(), width, height, allowed });
        }
        let file = OutputFile::create_with_folders(path)?;
        let waiting = BufWriter::new(file.scratch()?);
        let step = frame_step(fps);
        Ok(Self {
            file,
            waiting,
            size,
            step,
            ticks: TICKS_PER_S * f64::from(step) / fps,
            pushed: 0,
            kept: 0,
            histogram: Histogram::new(),
        })
    }

    /// Returns true if the next frame is one of those that are kept.
    fn wants_next(&self) -> bool {
        self.pushed.is_multiple_of(self.step)
    }

    /// Counts a frame that is not kept.
    pub(super) fn skip(&mut self) {
        self.pushed += 1;
    }

    pub(super) fn push(&mut self, frame: &RgbaImage) -> Result<(), OutputError> {
        let keep = self.wants_next();
        self.skip();
        if !keep {
            return Ok(());
        }
        self.kept += 1;
        let mut bytes = Vec::with_capacity(frame.as_raw().len() / 4 * 3);
        for pixel in frame.pixels() {
            let [red, green, blue, _] = pixel.0;
            self.histogram.add([red, green, blue]);
            bytes.extend([red, green, blue]);
        }
        Ok(self.waiting.write_all(&bytes).map_err(WriteError::at(self.file.destination()))?)
    }

    pub(super) fn finish(mut self) -> Result<(), OutputError> {
        let destination = self.file.destination().to_owned();
        let frames =
            self.waiting.into_inner().map_err(|error| WriteError::at(&destination)(error.into_error()))?;
        let mut frames = BufReader::new(frames);
        frames.rewind().map_err(WriteError::at(&destination))?;
        let encode = |error: EncodingError| match error {
            EncodingError::Io(reason) => WriteError::at(&destination)(reason).into(),
            other => OutputError::Encode { path: destination.clone(), reason: other.to_string() },
        };
        let mut palette = self.histogram.palette();
        let [width, height] = [self.size.0, self.size.1].map(|edge| u16::try_from(edge).unwrap_or(u16::MAX));
        let mut encoder =
            Encoder::new(BufWriter::new(&mut self.file), width, height, palette.bytes()).map_err(encode)?;
        encoder.set_repeat(Repeat::Infinite).map_err(encode)?;
        let pixels = usize::from(width) * usize::from(height);
        let mut frame = vec![0u8; 3 * pixels];
        let mut shown: Vec<Option<Shown>> = vec![None; pixels];
        for number in 0..self.kept {
            frames.read_exact(&mut frame).map_err(WriteError::at(&destination))?;
            let changed = changes(&frame, &mut shown, &mut palette, self.size.0);
            let delay = delay_ticks(self.ticks, number);
            encoder.write_frame(&cut_out(&changed, width, delay)).map_err(encode)?;
        }
        let mut output = encoder.into_inner().map_err(encode)?;
        output.flush().map_err(WriteError::at(&destination))?;
        drop(output);
        Ok(self.file.finish()?)
    }
}

/// Contents of a pixel: its number in the palette and the colour it stands for.
#[derive(Clone, Copy, Debug)]
struct Shown {
    number: u8,
    meant: [u8; 3],
}

/// Palette numbers of the dithered picture where it differs from what is shown, `UNCHANGED` elsewhere.
fn changes(frame: &[u8], shown: &mut [Option<Shown>], palette: &mut Palette, width: u32) -> Vec<u8> {
    let (mut x, mut y) = (0, 0);
    let mut next = |pixel: &[u8; 3], shown: &mut Option<Shown>| {
        let at = (x, y);
        x += 1;
        if x == width {
            (x, y) = (0, y + 1);
        }
        let near = |meant: [u8; 3]| pixel.iter().zip(meant).all(|(a, b)| a.abs_diff(b) < UNSEEN);
        if shown.is_some_and(|shown| near(shown.meant)) {
            return UNCHANGED;
        }
        let number = palette.dithered(*pixel, at.0, at.1);
        let same = shown.is_some_and(|shown| shown.number == number);
        *shown = Some(Shown { number, meant: *pixel });
        if same { UNCHANGED } else { number }
    };
    frame.as_chunks::<3>().0.iter().zip(shown).map(|(pixel, shown)| next(pixel, shown)).collect()
}

/// The smallest rectangle that holds all changes; one unchanged pixel where there are none.
fn cut_out(changed: &[u8], width: u16, delay: u16) -> Frame<'static> {
    let wide = usize::from(width);
    let (mut left, mut top, mut right, mut bottom) = (wide, usize::MAX, 0, 0);
    for (y, row) in changed.chunks_exact(wide).enumerate() {
        if let Some(first) = row.iter().position(|&number| number != UNCHANGED) {
            let last = row.iter().rposition(|&number| number != UNCHANGED).unwrap_or(first);
            (left, right) = (left.min(first), right.max(last + 1));
            (top, bottom) = (top.min(y), y + 1);
        }
    }
    if right == 0 {
        (left, top, right, bottom) = (0, 0, 1, 1);
    }
    let rows = changed.chunks_exact(wide).skip(top).take(bottom - top);
    let buffer: Vec<u8> = rows.flat_map(|row| &row[left..right]).copied().collect();
    let edge = |edge: usize| u16::try_from(edge).unwrap_or(u16::MAX);
    Frame {
        delay,
        transparent: Some(UNCHANGED),
        left: edge(left),
        top: edge(top),
        width: edge(right - left),
        height: edge(bottom - top),
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// Keeps every n-th frame so that at most `MAX_FPS` remain.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "fps is at most 1000")]
pub(super) fn frame_step(fps: f64) -> u32 {
    (fps / MAX_FPS).ceil().max(1.0) as u32
}

/// Whole hundredths of a second for frame `number`, so that the sum never strays from the true time.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and small")]
fn delay_ticks(ticks: f64, number: u32) -> u16 {
    let until = |frame: u32| (ticks * f64::from(frame)).round() as u64;
    u16::try_from(until(number + 1) - until(number)).unwrap_or(u16::MAX).max(1)
}

/// A clip needs a frame rate.
pub(super) fn check_rate(path: &Path, fps: f64) -> Result<(), OutputError> {
    if fps > 0.0 && fps <= 1000.0 {
        return Ok(());
    }
    Err(OutputError::FrameRate { path: path.to_owned(), fps })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_add_up_to_the_true_time() {
        let step = frame_step(60.0);
        assert_eq!(step, 2, "60 frames per second become 30");
        let total: u16 = (0..30).map(|number| delay_ticks(100.0 * f64::from(step) / 60.0, number)).sum();
        assert_eq!(total, 100, "30 frames take a second");
    }
}
