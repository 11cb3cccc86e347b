// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Time by which the lens adapts to brightness.

/// Moment of a frame for the lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensMoment {
    /// Seconds since it adapted at once; 0 lets it do so now.
    pub clock_s: f64,
    /// Seconds since the frame before.
    pub since_s: f64,
}

impl LensMoment {
    /// A frame without any before it.
    pub const FIRST: Self = Self { clock_s: 0.0, since_s: 0.0 };

    /// Frame of a clip, counted from 0, with a frame every `frame_s` seconds.
    pub fn of_frame(number: u32, frame_s: f64) -> Self {
        Self { clock_s: f64::from(number) * frame_s, since_s: frame_s }
    }

    /// The next frame, `since_s` seconds later; infinite for one that has none before it.
    pub fn after(self, since_s: f64) -> Self {
        if since_s.is_finite() { Self { clock_s: self.clock_s + since_s, since_s } } else { Self::FIRST }
    }
}
