// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A clip of what the window shows, frame by frame at a fixed rate, however long a frame takes to draw.

use std::path::{Path, PathBuf};

use anyhow::bail;
use image::RgbaImage;
use windfall_render::PictureTarget;
use windfall_wgpu::Gpu;

use crate::output::{Output, Writer};
use crate::run::frame_steps::FrameSteps;

/// Frames in each second of the clip.
pub(crate) const FPS: f64 = 60.0;

/// State of recording.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ClipStatus {
    /// Path that the clip will lie at.
    pub(crate) path: String,
    /// Frames so far, while one is being made.
    pub(crate) frames: Option<u32>,
}

/// A clip in the making.
#[derive(Debug)]
pub(crate) struct Recording {
    writer: Writer,
    /// Target of its pictures.
    pub(crate) target: PictureTarget,
    /// Width and height in pixels.
    pub(crate) size: (u32, u32),
    steps: FrameSteps,
    frames: u32,
}

impl Recording {
    /// Begins a clip at `path` of pictures of about `size` pixels, in which `time_scale` simulated seconds pass in each.
    ///
    /// # Errors
    /// A name that is taken or of no known kind, a place that cannot be written, a missing ffmpeg, time that stands still.
    pub(crate) fn start(
        path: &str,
        gpu: &Gpu,
        format: wgpu::TextureFormat,
        size: (u32, u32),
        (time_scale, dt_s): (f32, f32),
    ) -> anyhow::Result<Self> {
        let path = Path::new(path.trim());
        if path.exists() {
            bail!("{}: there is something of this name; allowed: a new name", path.display());
        }
        if time_scale <= 0.0 {
            bail!("time scale is {time_scale}; allowed while recording: above 0");
        }
        // Videos hold even numbers only.
        let size = (size.0 & !1, size.1 & !1);
        let target = PictureTarget::with_format(gpu.device(), size, format)?;
        let writer = Output::from_path(path)?.start(size, FPS)?;
        let steps = FrameSteps::new(FPS, time_scale.into(), dt_s);
        Ok(Self { writer, target, size, steps, frames: 0 })
    }

    /// Steps from the frame that was taken last to the next one.
    pub(crate) fn due_steps(&self) -> u32 {
        let Some(last) = self.frames.checked_sub(1) else { return 0 };
        u32::try_from(self.steps.before(self.frames) - self.steps.before(last)).unwrap_or(u32::MAX)
    }

    /// Frames so far.
    pub(crate) fn frames(&self) -> u32 {
        self.frames
    }

    /// Returns true if its pictures fit into one of `size` pixels.
    pub(crate) fn fits(&self, (width, height): (u32, u32)) -> bool {
        self.size.0 <= width && self.size.1 <= height
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// A full disk, a failed ffmpeg.
    pub(crate) fn push(&mut self, picture: &RgbaImage) -> anyhow::Result<()> {
        self.writer.push(picture)?;
        self.frames += 1;
        Ok(())
    }

    /// Completes the clip and returns its path.
    ///
    /// # Errors
    /// Errors of the system; no frame yet.
    pub(crate) fn finish(self) -> anyhow::Result<PathBuf> {
        Ok(self.writer.finish()?)
    }
}

/// The first name of a clip of `scene` that `is_taken` does not know.
pub(crate) fn free_name(scene: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let letter = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let stem: String = scene.chars().map(letter).collect();
    let name = |number: u32| format!("{stem}-{number}.mp4");
    (1..).map(name).find(|name| !is_taken(name)).unwrap_or_else(|| name(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_new() {
        assert_eq!(free_name("Autumn park", |_| false), "autumn-park-1.mp4", "of the scene");
        let taken = |name: &str| ["a-b-1.mp4", "a-b-2.mp4"].contains(&name);
        assert_eq!(free_name("a/b", taken), "a-b-3.mp4", "the next, in this folder");
    }

    #[test]
    fn a_clip_has_every_frame_and_the_steps_between() {
        let gpu = Gpu::request(None).expect("an adapter; apt install mesa-vulkan-drivers");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("clip");
        let name = path.to_str().expect("plain");
        let format = PictureTarget::FORMAT;
        let start = |name: &str, scale| Recording::start(name, &gpu, format, (33, 18), (scale, 1.0 / 120.0));
        let mut recording = start(name, 0.75).expect("it begins");
        assert_eq!(recording.size, (32, 18), "even");
        assert!(recording.fits((32, 18)) && !recording.fits((31, 18)), "only into what is as large");
        let mut steps = Vec::new();
        for _ in 0..5 {
            steps.push(recording.due_steps());
            recording.push(&RgbaImage::new(32, 18)).expect("room for a picture");
        }
        assert_eq!(
            steps,
            [0, 1, 2, 1, 2],
            "one and a half of a 120th of a second each, whatever the wall says"
        );
        assert!(!path.exists(), "nothing half-written");
        assert_eq!(recording.finish().expect("whole"), path, "where it was wanted");
        assert_eq!(std::fs::read_dir(&path).expect("a folder").count(), 5, "every frame");
        let error = start(name, 1.0).expect_err("taken").to_string();
        assert!(error.contains(name) && error.contains("new name"), "{error}");
        let error = start("clip.avi", 1.0).expect_err("unknown").to_string();
        assert!(error.contains("clip.avi"), "{error}");
        assert!(start("standing", 0.0).is_err(), "no time passes");
    }
}
