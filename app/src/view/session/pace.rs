// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns the time that passes at the wall into whole steps.

/// Most steps in one frame: what would take longer than it lasts must not pile up.
const MAX_STEPS: u32 = 32;
/// Time that the steps of one frame may take, in seconds, unless a single one takes longer.
const BUDGET_S: f64 = 0.06;
/// Longest time between two frames that counts, in seconds: after a pause of the whole program time does not jump.
const MAX_FRAME_S: f64 = 0.5;
/// Longest such time that counts for the pace that is kept.
const MAX_ABSENCE_S: f64 = 2.0;
/// Time in seconds over which the pace is averaged.
const MEMORY_S: f64 = 1.5;
/// Below this part of the pace asked for, the panel says so.
const BEHIND: f64 = 0.93;

/// Pace of simulated time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    /// Simulated seconds in each second.
    pub(crate) time_scale: f32,
    /// True if time stands still.
    pub(crate) is_paused: bool,
    owed_s: f64,
    asked_s: f64,
    taken_s: f64,
}

impl Default for Pace {
    fn default() -> Self {
        Self { time_scale: 1.0, is_paused: false, owed_s: 0.0, asked_s: 0.0, taken_s: 0.0 }
    }
}

impl Pace {
    /// Number of steps of `dt_s` to take now, `frame_s` after the last time. A step takes about `step_cost_s` to
    /// compute. What cannot be done in time is dropped: then simulated time goes slower.
    pub(crate) fn steps(&mut self, frame_s: f64, dt_s: f64, step_cost_s: f64) -> u32 {
        if self.is_paused {
            return 0;
        }
        let asked_s = frame_s.min(MAX_FRAME_S) * f64::from(self.time_scale);
        self.owed_s += asked_s;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturating is right")]
        let whole = |number: f64| number as u32;
        let affordable = whole(BUDGET_S / step_cost_s.max(1.0e-9)).clamp(1, MAX_STEPS);
        let due = whole(self.owed_s / dt_s);
        let steps = due.min(affordable);
        // Of what is dropped nothing comes back later in a burst.
        self.owed_s = (self.owed_s - f64::from(steps) * dt_s).min(dt_s);
        let kept = (-frame_s / MEMORY_S).exp();
        self.asked_s = self.asked_s * kept + frame_s.min(MAX_ABSENCE_S) * f64::from(self.time_scale);
        self.taken_s = self.taken_s * kept + f64::from(steps) * dt_s;
        steps
    }

    /// Simulated seconds in each second that were reached lately, if notably less than asked for.
    pub(crate) fn behind(&self) -> Option<f64> {
        let part = self.taken_s / self.asked_s.max(1.0e-9);
        let is_known = self.asked_s > 0.3 * f64::from(self.time_scale) && !self.is_paused;
        (is_known && part < BEHIND).then_some(part * f64::from(self.time_scale))
    }

    /// Forgets how it went, after something that took its time.
    pub(crate) fn restart(&mut self) {
        *self = Self { time_scale: self.time_scale, is_paused: self.is_paused, ..Self::default() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT_S: f64 = 1.0 / 60.0;

    #[test]
    fn steps_follow_the_wall_and_the_time_scale() {
        let mut pace = Pace::default();
        let total: u32 = (0..144).map(|_| pace.steps(1.0 / 144.0, DT_S, 0.0)).sum();
        assert!((59..=60).contains(&total), "a second at 144 frames: {total} steps");
        pace.time_scale = 0.25;
        let total: u32 = (0..240).map(|_| pace.steps(DT_S, DT_S, 0.0)).sum();
        assert!((59..=61).contains(&total), "four seconds at a quarter: {total} steps");
        assert_eq!(pace.behind(), None, "it keeps up");
        pace.is_paused = true;
        assert_eq!(pace.steps(10.0, DT_S, 0.0), 0, "paused");
    }

    #[test]
    fn time_goes_slower_when_steps_are_too_dear() {
        let mut pace = Pace::default();
        for _ in 0..50 {
            let steps = pace.steps(0.1, DT_S, 0.03);
            assert!(steps <= 2, "0.06 s of steps in a frame, not {steps}");
        }
        let behind = pace.behind().expect("behind");
        assert!((behind - 1.0 / 3.0).abs() < 0.05, "two of six steps: {behind}");
        assert!(pace.steps(100.0, DT_S, 0.0) <= MAX_STEPS, "a long absence is no burst");
        assert!(pace.steps(DT_S, DT_S, 0.0) <= 2, "and is forgotten");
    }
}
