// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Frames of a clip that have to be drawn, and what a run has to do at the frames before them that they depend on.

use windfall_core::scene::Exposure;
use windfall_render::{LensMoment, is_metered, memory_s};

/// Work at a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shot {
    /// Draw it and keep the picture.
    Keep,
    /// Draw it for the lens, which adapts to it.
    Meter,
    /// Note where things are, for their trails and motion in the next one.
    Note,
    /// Simulate alone.
    Pass,
}

/// Frames of a clip, counted from the first that is simulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShotList {
    /// Frames that may be drawn are this many apart, and one of them is `first`.
    pub stride: u32,
    /// First frame that may be kept.
    pub first: u32,
    /// Last frame.
    pub last: u32,
    /// Seconds of the clip from a frame to the next.
    pub frame_s: f64,
    /// Metering of the lens, if it adapts from frame to frame: for a picture by itself it does so at once.
    pub adapts: Option<Exposure>,
    /// Pictures depend on all frames before them, as those do that show what things did since.
    pub needs_all: bool,
}

impl ShotList {
    /// Moment of a frame for the lens.
    pub(crate) fn moment(&self, number: u32) -> LensMoment {
        let since_s = f64::from(self.stride) * self.frame_s;
        self.adapts
            .map_or(LensMoment::FIRST, |_| LensMoment { clock_s: f64::from(number) * self.frame_s, since_s })
    }

    /// Returns true if a frame may be drawn.
    pub(crate) fn is_possible(&self, number: u32) -> bool {
        number % self.stride == self.first % self.stride
    }

    /// Work at every frame up to the last, if those are kept of which `is_wanted` is true. `shows` says if a picture so many frames later
    /// shows where things were; the next possible one if `true`.
    pub(crate) fn plan(
        &self,
        is_wanted: impl Fn(u32) -> bool,
        shows: impl Fn(u32, bool) -> bool,
    ) -> Vec<Shot> {
        let memory_s = self.adapts.as_ref().and_then(memory_s);
        let is_metered =
            |number| self.adapts.is_some_and(|exposure| is_metered(&exposure, self.moment(number)));
        // The next frames that are kept and that are drawn.
        let (mut kept, mut drawn) = (None, None);
        let mut plan: Vec<Shot> = (0..=self.last)
            .rev()
            .map(|number| {
                if !self.is_possible(number) {
                    return Shot::Pass;
                }
                if number >= self.first && is_wanted(number) {
                    (kept, drawn) = (Some(number), Some(number));
                    return Shot::Keep;
                }
                let (Some(next_kept), Some(next_drawn)) = (kept, drawn) else { return Shot::Pass };
                let is_remembered = |memory_s| f64::from(next_kept - number) * self.frame_s < memory_s;
                let counts = memory_s.is_some_and(is_remembered) && is_metered(number);
                if self.needs_all || counts {
                    drawn = Some(number);
                    return Shot::Meter;
                }
                let ahead = next_drawn - number;
                if shows(ahead, ahead == self.stride) { Shot::Note } else { Shot::Pass }
            })
            .collect();
        plan.reverse();
        plan
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(first: u32, last: u32, stride: u32, exposure: Exposure) -> ShotList {
        ShotList { stride, first, last, frame_s: 1.0 / 60.0, adapts: Some(exposure), needs_all: false }
    }

    fn count(plan: &[Shot], shot: Shot) -> usize {
        plan.iter().filter(|&&found| found == shot).count()
    }

    #[test]
    fn a_whole_clip_is_drawn_as_it_comes() {
        let plan = list(0, 99, 1, Exposure::default()).plan(|_| true, |_, _| true);
        assert_eq!(count(&plan, Shot::Keep), 100, "{plan:?}");
        let plan = list(0, 99, 2, Exposure::default()).plan(|_| true, |_, _| true);
        assert_eq!((count(&plan, Shot::Keep), count(&plan, Shot::Pass)), (50, 50), "{plan:?}");
    }

    #[test]
    fn a_part_meters_a_few_frames_and_notes_those_before_what_is_drawn() {
        let plan = list(900, 910, 1, Exposure::default()).plan(|_| true, |_, is_next| is_next);
        assert_eq!(count(&plan, Shot::Keep), 11, "the part");
        assert!((15..=17).contains(&count(&plan, Shot::Meter)), "four time constants: {plan:?}");
        assert_eq!(plan[..700].iter().filter(|&&shot| shot != Shot::Pass).count(), 0, "long before");
        for (number, pair) in plan.windows(2).enumerate() {
            let is_drawn = |shot| matches!(shot, Shot::Keep | Shot::Meter);
            let is_ready = pair[0] == Shot::Note || is_drawn(pair[0]);
            assert!(!is_drawn(pair[1]) || is_ready, "frame {} needs the one before", number + 1);
        }
        let plan = list(900, 910, 1, Exposure::Manual { ev100: 14.0 }).plan(|_| true, |_, is_next| is_next);
        assert_eq!((count(&plan, Shot::Meter), count(&plan, Shot::Note)), (0, 1), "nothing is metered");
    }

    #[test]
    fn what_is_there_is_not_drawn_again_unless_all_is_needed() {
        let mut list = list(0, 400, 1, Exposure::default());
        let plan = list.plan(|number| number == 5 || number >= 350, |_, _| false);
        assert_eq!(count(&plan, Shot::Keep), 1 + 51, "the missing ones");
        assert!(plan[6..150].iter().all(|&shot| shot == Shot::Pass), "{plan:?}");
        assert_eq!(plan[0], Shot::Meter, "the lens begins with the first frame");
        let plan = list.plan(|_| false, |_, _| true);
        assert_eq!(count(&plan, Shot::Pass), 401, "nothing is missing");
        list.needs_all = true;
        let plan = list.plan(|number| number == 350, |_, _| false);
        assert_eq!(count(&plan, Shot::Meter), 350, "all before it");
    }
}
