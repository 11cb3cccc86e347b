// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Times of the parts of a frame, averaged so that the numbers can be read.

use std::time::{Duration, Instant};

use crate::view::tools::frame_times::{FrameTimes, Frames};

/// Time in seconds over which numbers are averaged.
const MEMORY_S: f32 = 0.7;

/// A part of a frame on the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    Simulate,
    Upload,
    Panel,
    Draw,
    Wait,
}

/// Names of the stages, in their order.
pub(crate) const STAGES: [&str; 5] = ["simulate", "upload", "panel", "draw", "wait"];

/// Stopwatches of the frame.
#[derive(Debug)]
pub(crate) struct Meter {
    began: Instant,
    frame_s: Option<f32>,
    running: [Duration; STAGES.len()],
    mean_ms: Option<[f32; STAGES.len()]>,
    frames: Frames,
}

impl Meter {
    pub(crate) fn new() -> Self {
        let running = [Duration::ZERO; STAGES.len()];
        Self { began: Instant::now(), frame_s: None, running, mean_ms: None, frames: Frames::default() }
    }

    /// Starts the next frame and returns the seconds since the last one started.
    pub(crate) fn begin_frame(&mut self) -> f64 {
        let now = Instant::now();
        let passed = now - self.began;
        self.began = now;
        let frame_s = passed.as_secs_f32();
        let keep = (-frame_s / MEMORY_S).exp();
        let blend = |mean: f32, new: f32| mean * keep + new * (1.0 - keep);
        let new: [f32; STAGES.len()] = std::array::from_fn(|stage| self.running[stage].as_secs_f32() * 1.0e3);
        self.frames.push(FrameTimes { whole_ms: frame_s * 1.0e3, stages_ms: new });
        self.frame_s = Some(self.frame_s.map_or(frame_s, |mean| blend(mean, frame_s)));
        self.mean_ms = Some(
            self.mean_ms.map_or(new, |mean| std::array::from_fn(|stage| blend(mean[stage], new[stage]))),
        );
        self.running = [Duration::ZERO; STAGES.len()];
        passed.as_secs_f64()
    }

    /// Starts a frame after a time in which nothing had to be drawn, which is no part of any frame.
    pub(crate) fn resume(&mut self) {
        self.began = Instant::now();
        self.running = [Duration::ZERO; STAGES.len()];
    }

    /// Adds the time since `since` to a stage.
    pub(crate) fn add(&mut self, stage: Stage, since: Instant) {
        self.running[stage as usize] += since.elapsed();
    }

    /// Runs something as part of a stage.
    pub(crate) fn measure<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        let since = Instant::now();
        let result = work();
        self.add(stage, since);
        result
    }

    /// The latest frames.
    pub(crate) fn frames(&self) -> &Frames {
        &self.frames
    }

    /// Frames per second; zero before the second frame.
    pub(crate) fn fps(&self) -> f32 {
        self.frame_s.map_or(0.0, |seconds| 1.0 / seconds.max(1.0e-6))
    }

    /// Milliseconds of every stage.
    pub(crate) fn stages_ms(&self) -> [f32; STAGES.len()] {
        self.mean_ms.unwrap_or_default()
    }
}
