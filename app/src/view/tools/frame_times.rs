// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Times of the latest frames, each with its parts.

use std::collections::VecDeque;

use crate::view::tools::meter::STAGES;

/// Frames that are remembered.
pub(crate) const MEMORY: usize = 240;

/// A frame and its parts, in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FrameTimes {
    pub(crate) whole_ms: f32,
    pub(crate) stages_ms: [f32; STAGES.len()],
}

/// The latest frames, oldest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames {
    times: VecDeque<FrameTimes>,
}

impl Frames {
    pub(crate) fn push(&mut self, times: FrameTimes) {
        if self.times.len() == MEMORY {
            self.times.pop_front();
        }
        self.times.push_back(times);
    }

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &FrameTimes> {
        self.times.iter()
    }

    /// The time in milliseconds that this share of the frames did not exceed, 0 to 1; nothing before the first frame.
    pub(crate) fn quantile_ms(&self, share: f32) -> Option<f32> {
        let mut whole: Vec<f32> = self.times.iter().map(|times| times.whole_ms).collect();
        whole.sort_by(f32::total_cmp);
        // The nearest rank.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of frames"
        )]
        let rank = (share * whole.len() as f32).ceil() as usize;
        whole.get(rank.max(1) - 1).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_latest_frames() {
        let mut frames = Frames::default();
        assert_eq!(frames.quantile_ms(0.5), None, "nothing yet");
        // Long ago everything was slow.
        for _ in 0..50 {
            frames.push(FrameTimes { whole_ms: 900.0, ..FrameTimes::default() });
        }
        for index in 0..MEMORY {
            // 1 to 240 in a scrambled order.
            let whole_ms = ((index * 77) % MEMORY + 1) as f32;
            frames.push(FrameTimes { whole_ms, ..FrameTimes::default() });
        }
        assert_eq!(frames.iter().len(), MEMORY, "no more are remembered");
        assert_eq!(frames.quantile_ms(0.5), Some(120.0), "half of them");
        assert_eq!(frames.quantile_ms(0.99), Some(238.0), "all but two");
        assert_eq!(frames.quantile_ms(1.0), Some(240.0), "all of them");
        assert_eq!(frames.quantile_ms(0.0), Some(1.0), "the fastest");
    }
}
