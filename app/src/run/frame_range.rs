// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A stretch of frames.

/// Most frames that can be counted: their numbers have up to six digits.
const LAST: u32 = 999_999;

/// Frames from the first to the last, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FrameRange {
    /// Number of the first frame; frame 0 shows the scene as it begins.
    pub first: u32,
    /// Number of the last frame, at least that of the first.
    pub last: u32,
}

impl FrameRange {
    /// Reads a range such as 0..240.
    ///
    /// # Errors
    /// Names the allowed ranges.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse().ok().filter(|number| *number <= LAST);
        let range = text.split_once("..").and_then(|(first, last)| Some((number(first)?, number(last)?)));
        range.filter(|(first, last)| first <= last).map(|(first, last)| Self { first, last }).ok_or_else(|| {
            format!("allowed: FIRST..LAST such as 0..240, whole numbers from 0 to {LAST}, the last not before the first")
        })
    }

    /// Number of frames, at least one.
    pub(crate) fn count(self) -> u32 {
        self.last - self.first + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_and_checked() {
        assert_eq!(FrameRange::parse("3..9"), Ok(FrameRange { first: 3, last: 9 }), "a range");
        assert_eq!(FrameRange::parse("7..7").map(FrameRange::count), Ok(1), "one frame");
        for text in
            ["9..3", "-1..4", "1..-4", "4", "..", "1..", "..5", "1..=5", "0..1000000", "1.5..2", "", "0...3"]
        {
            let error = FrameRange::parse(text).expect_err("no range");
            assert!(error.contains("0..240") && error.contains("999999"), "{text}: {error}");
        }
    }
}
