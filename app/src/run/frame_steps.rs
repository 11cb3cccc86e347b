// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of steps before each frame of a clip.

use windfall_core::Cycle;

/// Picoseconds in a second.
const TICKS_PER_S: f64 = 1.0e12;

/// The steps of a clip: time is counted in whole picoseconds, so that nothing adds up over a long clip, and every frame
/// shows the state of the step nearest to its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSteps {
    frame_ticks: u128,
    step_ticks: u128,
}

impl FrameSteps {
    /// `fps` frames for each second of a clip that shows `speed` simulated seconds in it, in steps of `dt_s`. All are
    /// above zero.
    pub fn new(fps: f64, speed: f64, dt_s: f32) -> Self {
        Self { frame_ticks: ticks(speed / fps), step_ticks: ticks(f64::from(dt_s)).max(1) }
    }

    /// Number of steps from the beginning to frame `number`, counted from 0.
    pub fn before(&self, number: u32) -> u64 {
        let time = self.frame_ticks * u128::from(number);
        u64::try_from((time + self.step_ticks / 2) / self.step_ticks).unwrap_or(u64::MAX)
    }
}

/// The steps of one round of a scene that repeats: frames that divide it evenly, so that the first follows the last as
/// every other the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LoopFrames {
    run_in: u64,
    steps: u64,
    count: u32,
}

impl LoopFrames {
    /// About `rate` frames, at least one, for each simulated second of the cycle, whose steps take `dt_s`.
    pub(crate) fn new(cycle: &Cycle, rate: f64, dt_s: f32) -> Self {
        let frames = (f64::from(cycle.steps) * f64::from(dt_s) * rate).round().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, saturating")]
        let count = frames as u32;
        Self { run_in: cycle.run_in.into(), steps: cycle.steps.into(), count }
    }

    /// Number of frames.
    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// Number of steps from time zero to frame `number`, counted from 0; [`LoopFrames::count`] is the first again.
    pub(crate) fn step(&self, number: u32) -> u64 {
        self.run_in + u64::from(number) * self.steps / u64::from(self.count)
    }

    /// Number of steps from time zero to so many frames before the first.
    pub(crate) fn step_before(&self, number: u32) -> u64 {
        self.run_in.saturating_sub(u64::from(number) * self.steps / u64::from(self.count))
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, saturating")]
fn ticks(seconds: f64) -> u128 {
    (seconds * TICKS_PER_S).round() as u128
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_at_the_rate_of_the_steps_are_one_step_apart() {
        let steps = FrameSteps::new(60.0, 1.0, 1.0 / 60.0);
        for number in [0, 1, 2, 59, 60, 100_000] {
            assert_eq!(steps.before(number), u64::from(number), "frame {number}");
        }
    }

    #[test]
    fn other_rates_take_the_nearest_step_and_never_stray() {
        let steps = FrameSteps::new(24.0, 1.0, 1.0 / 60.0);
        let first: Vec<u64> = (0..5).map(|number| steps.before(number)).collect();
        assert_eq!(
            first,
            [0, 2, 5, 7, 10],
            "2.5 steps a frame, a step of a single-precision 1/60 s being a little longer"
        );
        assert_eq!(steps.before(24 * 3600), 60 * 3600, "an hour is an hour");
        let slow = FrameSteps::new(60.0, 0.25, 1.0 / 60.0);
        assert_eq!(slow.before(240), 60, "a quarter of the speed");
        assert!(FrameSteps::new(60.0, 1.0e9, 0.001).before(u32::MAX) > 1 << 40, "no overflow");
    }
}
